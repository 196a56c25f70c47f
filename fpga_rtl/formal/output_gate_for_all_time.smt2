; of 80fe8b80b9d5f11f157de4363f95134ca4a738e117c73ee7c990fa1cfa746d16, by python -m tests.rtl.proofs
(declare-sort |output_gate_s| 0)
(declare-fun |output_gate_is| (|output_gate_s|) Bool)
(declare-fun |output_gate#0| (|output_gate_s|) (_ BitVec 32)) ; \_witness_.anyinit_procdff_979
(define-fun |output_gate_n _witness_.anyinit_procdff_979| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#0| state))
(declare-fun |output_gate#1| (|output_gate_s|) (_ BitVec 1)) ; \shut_1_q
(define-fun |output_gate#2| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#1| state)) #b1) #b1 #b0)) ; $procmux$874_Y
(declare-fun |output_gate#3| (|output_gate_s|) (_ BitVec 1)) ; \rst_1_q
(define-fun |output_gate#4| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#3| state)) #b1) #b0 (|output_gate#2| state))) ; $procmux$876_Y
(declare-fun |output_gate#5| (|output_gate_s|) (_ BitVec 1)) ; \started_q
(define-fun |output_gate#6| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#5| state)) #b1) (|output_gate#4| state) #b0)) ; \a_fault_is_counted_EN
(define-fun |output_gate_n a_fault_is_counted_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#6| state)) #b1))
(declare-fun |output_gate#7| (|output_gate_s|) (_ BitVec 32)) ; \since_limit_q
(define-fun |output_gate#8| ((state |output_gate_s|)) Bool (bvult (|output_gate#7| state) #b00000000111011100110101100101000)) ; $lt$output_gate_properties.vh:110$269_Y
(define-fun |output_gate#9| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#8| state) #b1 #b0)) ; $procmux$835_Y
(define-fun |output_gate#10| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#5| state)) #b1) (|output_gate#9| state) #b0)) ; \a_limit_rests_EN
(define-fun |output_gate_n a_limit_rests_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#10| state)) #b1))
(declare-fun |output_gate#11| (|output_gate_s|) (_ BitVec 17)) ; \age_1_q
(define-fun |output_gate_n age_1_q| ((state |output_gate_s|)) (_ BitVec 17) (|output_gate#11| state))
(declare-fun |output_gate#12| (|output_gate_s|) (_ BitVec 17)) ; \age_2_q
(define-fun |output_gate_n age_2_q| ((state |output_gate_s|)) (_ BitVec 17) (|output_gate#12| state))
(declare-fun |output_gate#13| (|output_gate_s|) (_ BitVec 17)) ; \age_3_q
(define-fun |output_gate_n age_3_q| ((state |output_gate_s|)) (_ BitVec 17) (|output_gate#13| state))
(declare-fun |output_gate#14| (|output_gate_s|) (_ BitVec 17)) ; \age_4_q
(define-fun |output_gate_n age_4_q| ((state |output_gate_s|)) (_ BitVec 17) (|output_gate#14| state))
(declare-fun |output_gate#15| (|output_gate_s|) (_ BitVec 17)) ; \age_q
(define-fun |output_gate_n age_q| ((state |output_gate_s|)) (_ BitVec 17) (|output_gate#15| state))
(declare-fun |output_gate#16| (|output_gate_s|) (_ BitVec 11)) ; \alive_left_q
(define-fun |output_gate_n alive_left_q| ((state |output_gate_s|)) (_ BitVec 11) (|output_gate#16| state))
(declare-fun |output_gate#17| (|output_gate_s|) (_ BitVec 1)) ; \silent_q
(define-fun |output_gate#18| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#17| state)) #b1) false))) ; \alive_o
(define-fun |output_gate_n alive_o| ((state |output_gate_s|)) Bool (|output_gate#18| state))
(declare-fun |output_gate#19| (|output_gate_s|) (_ BitVec 16)) ; \all_faults_1_q
(define-fun |output_gate_n all_faults_1_q| ((state |output_gate_s|)) (_ BitVec 16) (|output_gate#19| state))
(declare-fun |output_gate#20| (|output_gate_s|) (_ BitVec 1)) ; \allowed_q
(define-fun |output_gate_n allowed_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#20| state)) #b1))
(declare-fun |output_gate#21| (|output_gate_s|) (_ BitVec 1)) ; \clock_lost_i
(define-fun |output_gate#22| ((state |output_gate_s|)) (_ BitVec 32) (ite (= ((_ extract 0 0) (|output_gate#21| state)) #b1) #b00000000000000000000000000000000 (|output_gate#0| state))) ; \channel_q
(define-fun |output_gate#23| ((state |output_gate_s|)) Bool (distinct (|output_gate#22| state) #b00000000000000000000000000000000)) ; $ne$output_gate_properties.vh:134$358_Y
(declare-fun |output_gate#24| (|output_gate_s|) (_ BitVec 1)) ; \_witness_.anyinit_procdff_982
(define-fun |output_gate#25| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#21| state)) #b1) #b0 (|output_gate#24| state))) ; \hv_enable_q
(define-fun |output_gate#26| ((state |output_gate_s|)) Bool (or  (|output_gate#23| state) false  (= ((_ extract 0 0) (|output_gate#25| state)) #b1) false)) ; $logic_or$output_gate_properties.vh:75$183_Y
(declare-fun |output_gate#27| (|output_gate_s|) (_ BitVec 1)) ; \_witness_.anyinit_procdff_988
(define-fun |output_gate#28| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#21| state)) #b1) #b0 (|output_gate#27| state))) ; \hv_alive_q
(define-fun |output_gate#29| ((state |output_gate_s|)) Bool (or  (|output_gate#26| state) false  (= ((_ extract 0 0) (|output_gate#28| state)) #b1) false)) ; $logic_or$output_gate_properties.vh:75$184_Y
(declare-fun |output_gate#30| (|output_gate_s|) (_ BitVec 1)) ; \_witness_.anyinit_procdff_985
(define-fun |output_gate#31| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#21| state)) #b1) #b0 (|output_gate#30| state))) ; \focus_q
(define-fun |output_gate#32| ((state |output_gate_s|)) Bool (or  (|output_gate#29| state) false  (= ((_ extract 0 0) (|output_gate#31| state)) #b1) false)) ; \any
(define-fun |output_gate_n any| ((state |output_gate_s|)) Bool (|output_gate#32| state))
(declare-fun |output_gate#33| (|output_gate_s|) (_ BitVec 1)) ; \arm_1_q
(define-fun |output_gate_n arm_1_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#33| state)) #b1))
(declare-fun |output_gate#34| (|output_gate_s|) Bool) ; \arm_i
(define-fun |output_gate_n arm_i| ((state |output_gate_s|)) Bool (|output_gate#34| state))
(declare-fun |output_gate#35| (|output_gate_s|) (_ BitVec 3)) ; \state_q
(define-fun |output_gate#36| ((state |output_gate_s|)) Bool (= (|output_gate#35| state) #b010)) ; \armed_o
(define-fun |output_gate_n armed_o| ((state |output_gate_s|)) Bool (|output_gate#36| state))
(declare-fun |output_gate#37| (|output_gate_s|) (_ BitVec 5)) ; \limits_1_q
(define-fun |output_gate#38| ((state |output_gate_s|)) Bool (distinct (|output_gate#37| state) #b00000)) ; $ne$output_gate_properties.vh:83$215_Y
(define-fun |output_gate#39| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#38| state) #b1 #b0)) ; $procmux$937_Y
(define-fun |output_gate#40| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#5| state)) #b1) (|output_gate#39| state) #b0)) ; \beyond_is_off_EN
(define-fun |output_gate_n beyond_is_off_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#40| state)) #b1))
(declare-fun |output_gate#41| (|output_gate_s|) (_ BitVec 16)) ; \bit_ticks_i
(define-fun |output_gate_n bit_ticks_i| ((state |output_gate_s|)) (_ BitVec 16) (|output_gate#41| state))
(declare-fun |output_gate#42| (|output_gate_s|) (_ BitVec 1)) ; \live_q
(declare-fun |output_gate#43| (|output_gate_s|) Bool) ; \run_permit_i
(define-fun |output_gate#44| ((state |output_gate_s|)) Bool (not (or  (|output_gate#43| state) false))) ; $logic_not$output_gate.v:86$18_Y
(define-fun |output_gate#45| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 0 0) (|output_gate#42| state)) #b1) false) (or  (|output_gate#44| state) false))) ; \cause [0]
(define-fun |output_gate#46| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 0 0) (|output_gate#42| state)) #b1) false) (or  (= ((_ extract 0 0) (|output_gate#17| state)) #b1) false))) ; \cause [1]
(declare-fun |output_gate#47| (|output_gate_s|) Bool) ; \temperature_good_i
(define-fun |output_gate#48| ((state |output_gate_s|)) Bool (not (or  (|output_gate#47| state) false))) ; $logic_not$output_gate.v:88$21_Y
(define-fun |output_gate#49| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 0 0) (|output_gate#42| state)) #b1) false) (or  (|output_gate#48| state) false))) ; \cause [2]
(declare-fun |output_gate#50| (|output_gate_s|) Bool) ; \underrun_i
(define-fun |output_gate#51| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 0 0) (|output_gate#42| state)) #b1) false) (or  (|output_gate#50| state) false))) ; \cause [3]
(declare-fun |output_gate#52| (|output_gate_s|) (_ BitVec 5)) ; \limits_i
(define-fun |output_gate#53| ((state |output_gate_s|)) (_ BitVec 5) (bvand (|output_gate#52| state) (concat (|output_gate#42| state) (concat (|output_gate#42| state) (concat (|output_gate#42| state) (concat (|output_gate#42| state) (|output_gate#42| state))))))) ; \cause [8:4]
(define-fun |output_gate_n cause| ((state |output_gate_s|)) (_ BitVec 9) (concat (|output_gate#53| state) (concat (ite (|output_gate#51| state) #b1 #b0) (concat (ite (|output_gate#49| state) #b1 #b0) (concat (ite (|output_gate#46| state) #b1 #b0) (ite (|output_gate#45| state) #b1 #b0))))))
(declare-fun |output_gate#54| (|output_gate_s|) (_ BitVec 32)) ; \channel_mask_i
(define-fun |output_gate_n channel_mask_i| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#54| state))
(define-fun |output_gate_n channel_o| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#22| state))
(define-fun |output_gate_n channel_q| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#22| state))
(declare-fun |output_gate#55| (|output_gate_s|) (_ BitVec 1)) ; \clear_1_q
(define-fun |output_gate_n clear_1_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#55| state)) #b1))
(declare-fun |output_gate#56| (|output_gate_s|) Bool) ; \clear_i
(define-fun |output_gate_n clear_i| ((state |output_gate_s|)) Bool (|output_gate#56| state))
(declare-fun |output_gate#57| (|output_gate_s|) Bool) ; \clk_i
(define-fun |output_gate_n clk_i| ((state |output_gate_s|)) Bool (|output_gate#57| state))
(define-fun |output_gate_n clock_lost_i| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#21| state)) #b1))
(declare-fun |output_gate#58| (|output_gate_s|) (_ BitVec 1)) ; \cool_1_q
(define-fun |output_gate_n cool_1_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#58| state)) #b1))
(declare-fun |output_gate#59| (|output_gate_s|) (_ BitVec 1)) ; \disarm_1_q
(define-fun |output_gate_n disarm_1_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#59| state)) #b1))
(declare-fun |output_gate#60| (|output_gate_s|) Bool) ; \disarm_i
(define-fun |output_gate_n disarm_i| ((state |output_gate_s|)) Bool (|output_gate#60| state))
(define-fun |output_gate#61| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#33| state)) #b1) false))) ; $logic_not$output_gate_properties.vh:102$251_Y
(define-fun |output_gate#62| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 0 0) (|output_gate#59| state)) #b1) false) (or  (|output_gate#61| state) false))) ; $logic_and$output_gate_properties.vh:102$252_Y
(define-fun |output_gate#63| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#62| state) #b1 #b0)) ; $procmux$860_Y
(define-fun |output_gate#64| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#3| state)) #b1) #b0 (|output_gate#63| state))) ; $procmux$862_Y
(define-fun |output_gate#65| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#5| state)) #b1) (|output_gate#64| state) #b0)) ; \disarm_is_obeyed_EN
(define-fun |output_gate_n disarm_is_obeyed_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#65| state)) #b1))
(declare-fun |output_gate#66| (|output_gate_s|) (_ BitVec 1)) ; \disarmed_q
(define-fun |output_gate#67| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#66| state)) #b1) #b1 #b0)) ; $procmux$845_Y
(define-fun |output_gate#68| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#5| state)) #b1) (|output_gate#67| state) #b0)) ; \disarmed_for_good_EN
(define-fun |output_gate_n disarmed_for_good_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#68| state)) #b1))
(define-fun |output_gate_n disarmed_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#66| state)) #b1))
(declare-fun |output_gate#69| (|output_gate_s|) (_ BitVec 32)) ; \drive_1_q
(define-fun |output_gate_n drive_1_q| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#69| state))
(declare-fun |output_gate#70| (|output_gate_s|) (_ BitVec 32)) ; \drive_i
(define-fun |output_gate_n drive_i| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#70| state))
(define-fun |output_gate#71| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#23| state) #b1 #b0)) ; $procmux$702_Y
(define-fun |output_gate#72| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#21| state)) #b1) #b0 (|output_gate#71| state))) ; $procmux$704_Y
(define-fun |output_gate#73| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#5| state)) #b1) (|output_gate#72| state) #b0)) ; \edges_once_settled_EN
(define-fun |output_gate_n edges_once_settled_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#73| state)) #b1))
(declare-fun |output_gate#74| (|output_gate_s|) (_ BitVec 32)) ; \emissions_q
(define-fun |output_gate_n emissions_o| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#74| state))
(define-fun |output_gate_n emissions_q| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#74| state))
(declare-fun |output_gate#75| (|output_gate_s|) Bool) ; \ended_i
(define-fun |output_gate_n ended_i| ((state |output_gate_s|)) Bool (|output_gate#75| state))
(define-fun |output_gate#76| ((state |output_gate_s|)) Bool (= (|output_gate#35| state) #b101)) ; \settling
(define-fun |output_gate#77| ((state |output_gate_s|)) Bool (= (|output_gate#35| state) #b001)) ; \ramp_up_o
(define-fun |output_gate#78| ((state |output_gate_s|)) Bool (or  (|output_gate#77| state) false  (|output_gate#36| state) false)) ; $logic_or$output_gate.v:81$10_Y
(define-fun |output_gate#79| ((state |output_gate_s|)) Bool (= (|output_gate#35| state) #b011)) ; \stopping_o
(define-fun |output_gate#80| ((state |output_gate_s|)) Bool (or  (|output_gate#78| state) false  (|output_gate#79| state) false)) ; $logic_or$output_gate.v:81$12_Y
(define-fun |output_gate#81| ((state |output_gate_s|)) Bool (= (|output_gate#35| state) #b100)) ; \ramp_down_o
(define-fun |output_gate#82| ((state |output_gate_s|)) Bool (or  (|output_gate#80| state) false  (|output_gate#81| state) false)) ; \moves
(define-fun |output_gate#83| ((state |output_gate_s|)) Bool (or  (|output_gate#76| state) false  (|output_gate#82| state) false)) ; \on
(define-fun |output_gate#84| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#35| state)) #b1) (= ((_ extract 1 1) (|output_gate#35| state)) #b1) (= ((_ extract 2 2) (|output_gate#35| state)) #b1)))) ; \off_o
(define-fun |output_gate#85| ((state |output_gate_s|)) Bool (or  (|output_gate#83| state) false  (|output_gate#84| state) false)) ; \exists
(define-fun |output_gate_n exists| ((state |output_gate_s|)) Bool (|output_gate#85| state))
(declare-fun |output_gate#86| (|output_gate_s|) (_ BitVec 1)) ; \exists_1_q
(define-fun |output_gate_n exists_1_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#86| state)) #b1))
(declare-fun |output_gate#87| (|output_gate_s|) (_ BitVec 32)) ; \fault_count_1_q
(define-fun |output_gate_n fault_count_1_q| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#87| state))
(declare-fun |output_gate#88| (|output_gate_s|) (_ BitVec 32)) ; \fault_count_q
(define-fun |output_gate_n fault_count_o| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#88| state))
(define-fun |output_gate_n fault_count_q| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#88| state))
(declare-fun |output_gate#89| (|output_gate_s|) (_ BitVec 9)) ; \fault_q
(define-fun |output_gate_n fault_o| ((state |output_gate_s|)) (_ BitVec 16) (concat #b0000000 (|output_gate#89| state)))
(define-fun |output_gate_n fault_q| ((state |output_gate_s|)) (_ BitVec 9) (|output_gate#89| state))
(declare-fun |output_gate#90| (|output_gate_s|) (_ BitVec 64)) ; \fault_time_q
(define-fun |output_gate_n fault_time_o| ((state |output_gate_s|)) (_ BitVec 64) (|output_gate#90| state))
(define-fun |output_gate_n fault_time_q| ((state |output_gate_s|)) (_ BitVec 64) (|output_gate#90| state))
(declare-fun |output_gate#91| (|output_gate_s|) (_ BitVec 5)) ; \faults_1_q
(define-fun |output_gate_n faults_1_q| ((state |output_gate_s|)) (_ BitVec 5) (|output_gate#91| state))
(declare-fun |output_gate#92| (|output_gate_s|) (_ BitVec 1)) ; \fed_q
(define-fun |output_gate_n fed_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#92| state)) #b1))
(declare-fun |output_gate#93| (|output_gate_s|) (_ BitVec 32)) ; \fed_ticks_q
(define-fun |output_gate_n fed_ticks_q| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#93| state))
(declare-fun |output_gate#94| (|output_gate_s|) (_ BitVec 16)) ; \focus_left_q
(define-fun |output_gate_n focus_left_q| ((state |output_gate_s|)) (_ BitVec 16) (|output_gate#94| state))
(define-fun |output_gate_n focus_o| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#31| state)) #b1))
(define-fun |output_gate_n focus_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#31| state)) #b1))
(declare-fun |output_gate#95| (|output_gate_s|) Bool) ; \heartbeat_i
(define-fun |output_gate_n heartbeat_i| ((state |output_gate_s|)) Bool (|output_gate#95| state))
(declare-fun |output_gate#96| (|output_gate_s|) (_ BitVec 32)) ; \heartbeat_ticks_i
(define-fun |output_gate_n heartbeat_ticks_i| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#96| state))
(define-fun |output_gate#97| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#58| state)) #b1) #b0 #b1)) ; $procmux$907_Y
(declare-fun |output_gate#98| (|output_gate_s|) (_ BitVec 1)) ; \hv_1_q
(define-fun |output_gate#99| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#3| state)) #b1) false))) ; $logic_not$output_gate_properties.vh:111$271_Y
(define-fun |output_gate#100| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 0 0) (|output_gate#98| state)) #b1) false) (or  (|output_gate#99| state) false))) ; $logic_and$output_gate_properties.vh:91$227_Y
(define-fun |output_gate#101| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#100| state) (|output_gate#97| state) #b0)) ; $procmux$909_Y
(define-fun |output_gate#102| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#5| state)) #b1) (|output_gate#101| state) #b0)) ; \heat_is_kept_EN
(define-fun |output_gate_n heat_is_kept_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#102| state)) #b1))
(define-fun |output_gate_n host_silent| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#17| state)) #b1))
(define-fun |output_gate#103| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#5| state)) #b1) (|output_gate#97| state) #b0)) ; \hot_is_off_EN
(define-fun |output_gate_n hot_is_off_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#103| state)) #b1))
(define-fun |output_gate_n hv_1_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#98| state)) #b1))
(define-fun |output_gate_n hv_alive_o| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#28| state)) #b1))
(define-fun |output_gate_n hv_alive_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#28| state)) #b1))
(define-fun |output_gate_n hv_enable_o| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#25| state)) #b1))
(define-fun |output_gate_n hv_enable_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#25| state)) #b1))
(define-fun |output_gate_n limits_1_q| ((state |output_gate_s|)) (_ BitVec 5) (|output_gate#37| state))
(define-fun |output_gate#104| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#100| state) #b1 #b0)) ; $procmux$895_Y
(define-fun |output_gate#105| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#5| state)) #b1) (|output_gate#104| state) #b0)) ; \limits_are_kept_EN
(define-fun |output_gate_n limits_are_kept_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#105| state)) #b1))
(define-fun |output_gate_n limits_i| ((state |output_gate_s|)) (_ BitVec 5) (|output_gate#52| state))
(define-fun |output_gate_n live| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#42| state)) #b1))
(define-fun |output_gate#106| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#21| state)) #b1) #b0 #b1)) ; $procmux$790_Y
(define-fun |output_gate#107| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#5| state)) #b1) (|output_gate#106| state) #b0)) ; \live_is_anything_on_EN
(define-fun |output_gate_n live_is_anything_on_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#107| state)) #b1))
(define-fun |output_gate_n live_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#42| state)) #b1))
(define-fun |output_gate_n _witness_.anyinit_procdff_982| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#24| state)) #b1))
(define-fun |output_gate_n _witness_.anyinit_procdff_985| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#30| state)) #b1))
(define-fun |output_gate_n _witness_.anyinit_procdff_988| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#27| state)) #b1))
(declare-fun |output_gate#108| (|output_gate_s|) (_ BitVec 32)) ; \mask_1_q
(define-fun |output_gate_n mask_1_q| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#108| state))
(define-fun |output_gate#109| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#5| state)) #b1) #b1 #b0)) ; \mask_is_kept_EN
(define-fun |output_gate_n mask_is_kept_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#109| state)) #b1))
(define-fun |output_gate_n moves| ((state |output_gate_s|)) Bool (|output_gate#82| state))
(declare-fun |output_gate#110| (|output_gate_s|) (_ BitVec 3)) ; \moves_later_q
(define-fun |output_gate_n moves_later_q| ((state |output_gate_s|)) (_ BitVec 3) (|output_gate#110| state))
(define-fun |output_gate#111| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#82| state) #b1 #b0)) ; $procmux$734_Y
(define-fun |output_gate#112| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#21| state)) #b1) #b0 (|output_gate#111| state))) ; $procmux$736_Y
(define-fun |output_gate#113| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#5| state)) #b1) (|output_gate#112| state) #b0)) ; \moves_once_settled_EN
(define-fun |output_gate_n moves_once_settled_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#113| state)) #b1))
(define-fun |output_gate_n no_channel_alone_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#109| state)) #b1))
(define-fun |output_gate#114| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#21| state)) #b1) #b1 #b0)) ; \no_clock_is_off_EN
(define-fun |output_gate_n no_clock_is_off_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#114| state)) #b1))
(define-fun |output_gate_n no_sign_of_life_alone_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#109| state)) #b1))
(define-fun |output_gate#115| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#86| state)) #b1) #b0 #b1)) ; $procmux$927_Y
(define-fun |output_gate#116| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#5| state)) #b1) (|output_gate#115| state) #b0)) ; \nonsense_is_off_EN
(define-fun |output_gate_n nonsense_is_off_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#116| state)) #b1))
(declare-fun |output_gate#117| (|output_gate_s|) (_ BitVec 64)) ; \now_1_q
(define-fun |output_gate_n now_1_q| ((state |output_gate_s|)) (_ BitVec 64) (|output_gate#117| state))
(declare-fun |output_gate#118| (|output_gate_s|) (_ BitVec 64)) ; \now_i
(define-fun |output_gate_n now_i| ((state |output_gate_s|)) (_ BitVec 64) (|output_gate#118| state))
(define-fun |output_gate_n off_o| ((state |output_gate_s|)) Bool (|output_gate#84| state))
(define-fun |output_gate_n on| ((state |output_gate_s|)) Bool (|output_gate#83| state))
(declare-fun |output_gate#119| (|output_gate_s|) (_ BitVec 3)) ; \on_later_q
(define-fun |output_gate_n on_later_q| ((state |output_gate_s|)) (_ BitVec 3) (|output_gate#119| state))
(define-fun |output_gate#120| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#32| state) #b1 #b0)) ; $procmux$840_Y
(define-fun |output_gate#121| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#5| state)) #b1) (|output_gate#120| state) #b0)) ; \on_once_armed_EN
(define-fun |output_gate_n on_once_armed_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#121| state)) #b1))
(define-fun |output_gate_n on_while_fed_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#121| state)) #b1))
(define-fun |output_gate_n on_without_fault_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#121| state)) #b1))
(define-fun |output_gate#122| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#55| state)) #b1) #b0 #b1)) ; $procmux$881_Y
(define-fun |output_gate#123| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#3| state)) #b1) #b0 (|output_gate#122| state))) ; $procmux$883_Y
(define-fun |output_gate#124| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#5| state)) #b1) (|output_gate#123| state) #b0)) ; \only_a_command_clears_EN
(define-fun |output_gate_n only_a_command_clears_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#124| state)) #b1))
(define-fun |output_gate#125| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#1| state)) #b1) #b0 #b1)) ; $procmux$867_Y
(define-fun |output_gate#126| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#3| state)) #b1) #b0 (|output_gate#125| state))) ; $procmux$869_Y
(define-fun |output_gate#127| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#5| state)) #b1) (|output_gate#126| state) #b0)) ; \only_a_fault_counts_EN
(define-fun |output_gate_n only_a_fault_counts_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#127| state)) #b1))
(define-fun |output_gate_n only_what_is_played_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#109| state)) #b1))
(define-fun |output_gate#128| ((state |output_gate_s|)) Bool (or  (|output_gate#44| state) false  (= ((_ extract 0 0) (|output_gate#17| state)) #b1) false)) ; $logic_or$output_gate.v:92$27_Y
(define-fun |output_gate#129| ((state |output_gate_s|)) Bool (or  (|output_gate#128| state) false  (|output_gate#48| state) false)) ; $logic_or$output_gate.v:92$29_Y
(define-fun |output_gate#130| ((state |output_gate_s|)) Bool (or  (|output_gate#129| state) false  (|output_gate#50| state) false)) ; $logic_or$output_gate.v:92$30_Y
(define-fun |output_gate#131| ((state |output_gate_s|)) Bool (distinct (|output_gate#52| state) #b00000)) ; $ne$output_gate.v:92$31_Y
(define-fun |output_gate#132| ((state |output_gate_s|)) Bool (or  (|output_gate#130| state) false  (|output_gate#131| state) false)) ; \wrong
(define-fun |output_gate#133| ((state |output_gate_s|)) Bool (not (or  (|output_gate#132| state) false))) ; $logic_not$output_gate.v:93$33_Y
(define-fun |output_gate#134| ((state |output_gate_s|)) Bool (and (or  (|output_gate#85| state) false) (or  (|output_gate#133| state) false))) ; \stays
(define-fun |output_gate#135| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 2 2) (|output_gate#119| state)) #b1) false) (or  (|output_gate#134| state) false))) ; \open
(define-fun |output_gate_n open| ((state |output_gate_s|)) Bool (|output_gate#135| state))
(declare-fun |output_gate#136| (|output_gate_s|) (_ BitVec 1)) ; \permit_1_q
(define-fun |output_gate_n permit_1_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#136| state)) #b1))
(declare-fun |output_gate#137| (|output_gate_s|) Bool) ; \ramp_done_i
(define-fun |output_gate_n ramp_done_i| ((state |output_gate_s|)) Bool (|output_gate#137| state))
(define-fun |output_gate_n ramp_down_o| ((state |output_gate_s|)) Bool (|output_gate#81| state))
(define-fun |output_gate_n ramp_up_o| ((state |output_gate_s|)) Bool (|output_gate#77| state))
(define-fun |output_gate#138| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#3| state)) #b1) #b1 #b0)) ; $procmux$957_Y
(define-fun |output_gate#139| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#5| state)) #b1) (|output_gate#138| state) #b0)) ; \reset_is_off_EN
(define-fun |output_gate_n reset_is_off_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#139| state)) #b1))
(define-fun |output_gate_n rest_has_its_time_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#107| state)) #b1))
(declare-fun |output_gate#140| (|output_gate_s|) (_ BitVec 1)) ; \resting_q
(define-fun |output_gate#141| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#140| state)) #b1) #b1 #b0)) ; $procmux$796_Y
(define-fun |output_gate#142| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#21| state)) #b1) #b0 (|output_gate#141| state))) ; $procmux$798_Y
(define-fun |output_gate#143| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#5| state)) #b1) (|output_gate#142| state) #b0)) ; \rest_is_counted_EN
(define-fun |output_gate_n rest_is_counted_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#143| state)) #b1))
(declare-fun |output_gate#144| (|output_gate_s|) (_ BitVec 1)) ; \resting_1_q
(define-fun |output_gate#145| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 0 0) (|output_gate#144| state)) #b1) false) (or  (|output_gate#99| state) false))) ; $logic_and$output_gate_properties.vh:111$272_Y
(define-fun |output_gate#146| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#145| state) #b1 #b0)) ; $procmux$830_Y
(define-fun |output_gate#147| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#5| state)) #b1) (|output_gate#146| state) #b0)) ; \rest_is_kept_EN
(define-fun |output_gate_n rest_is_kept_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#147| state)) #b1))
(declare-fun |output_gate#148| (|output_gate_s|) (_ BitVec 32)) ; \rest_left_q
(define-fun |output_gate_n rest_left_q| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#148| state))
(define-fun |output_gate_n resting_1_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#144| state)) #b1))
(define-fun |output_gate_n resting_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#140| state)) #b1))
(define-fun |output_gate_n rst_1_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#3| state)) #b1))
(declare-fun |output_gate#149| (|output_gate_s|) Bool) ; \rst_i
(define-fun |output_gate_n rst_i| ((state |output_gate_s|)) Bool (|output_gate#149| state))
(define-fun |output_gate_n run_permit_i| ((state |output_gate_s|)) Bool (|output_gate#43| state))
(declare-fun |output_gate#150| (|output_gate_s|) (_ BitVec 16)) ; \settle_left_q
(define-fun |output_gate_n settle_left_q| ((state |output_gate_s|)) (_ BitVec 16) (|output_gate#150| state))
(declare-fun |output_gate#151| (|output_gate_s|) Bool) ; \settled_i
(define-fun |output_gate_n settled_i| ((state |output_gate_s|)) Bool (|output_gate#151| state))
(define-fun |output_gate_n settling| ((state |output_gate_s|)) Bool (|output_gate#76| state))
(define-fun |output_gate#152| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#76| state) #b1 #b0)) ; $procmux$742_Y
(define-fun |output_gate#153| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#21| state)) #b1) #b0 (|output_gate#152| state))) ; $procmux$744_Y
(define-fun |output_gate#154| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#5| state)) #b1) (|output_gate#153| state) #b0)) ; \settling_is_counted_EN
(define-fun |output_gate_n settling_is_counted_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#154| state)) #b1))
(define-fun |output_gate_n settling_o| ((state |output_gate_s|)) Bool (|output_gate#76| state))
(define-fun |output_gate#155| ((state |output_gate_s|)) Bool (distinct (concat (|output_gate#53| state) (concat (ite (|output_gate#51| state) #b1 #b0) (concat (ite (|output_gate#49| state) #b1 #b0) (concat (ite (|output_gate#46| state) #b1 #b0) (ite (|output_gate#45| state) #b1 #b0))))) #b000000000)) ; \shut
(define-fun |output_gate_n shut| ((state |output_gate_s|)) Bool (|output_gate#155| state))
(define-fun |output_gate_n shut_1_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#1| state)) #b1))
(define-fun |output_gate_n shut_o| ((state |output_gate_s|)) Bool (|output_gate#155| state))
(define-fun |output_gate#156| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#17| state)) #b1) #b0 #b1)) ; $procmux$758_Y
(define-fun |output_gate#157| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#21| state)) #b1) #b0 (|output_gate#156| state))) ; $procmux$760_Y
(define-fun |output_gate#158| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#5| state)) #b1) (|output_gate#157| state) #b0)) ; \silence_is_counted_EN
(define-fun |output_gate_n silence_is_counted_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#158| state)) #b1))
(declare-fun |output_gate#159| (|output_gate_s|) (_ BitVec 1)) ; \silent_1_q
(define-fun |output_gate#160| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#159| state)) #b1) #b1 #b0)) ; $procmux$900_Y
(define-fun |output_gate#161| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#100| state) (|output_gate#160| state) #b0)) ; $procmux$902_Y
(define-fun |output_gate#162| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#5| state)) #b1) (|output_gate#161| state) #b0)) ; \silence_is_kept_EN
(define-fun |output_gate_n silence_is_kept_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#162| state)) #b1))
(declare-fun |output_gate#163| (|output_gate_s|) (_ BitVec 32)) ; \silence_q
(define-fun |output_gate_n silence_q| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#163| state))
(define-fun |output_gate_n silent_1_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#159| state)) #b1))
(define-fun |output_gate_n silent_in_time_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#158| state)) #b1))
(define-fun |output_gate#164| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#5| state)) #b1) (|output_gate#160| state) #b0)) ; \silent_is_off_EN
(define-fun |output_gate_n silent_is_off_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#164| state)) #b1))
(define-fun |output_gate_n silent_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#17| state)) #b1))
(define-fun |output_gate_n since_limit_q| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#7| state))
(define-fun |output_gate_n started_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#5| state)) #b1))
(define-fun |output_gate_n state_q| ((state |output_gate_s|)) (_ BitVec 3) (|output_gate#35| state))
(define-fun |output_gate_n stays| ((state |output_gate_s|)) Bool (|output_gate#134| state))
(define-fun |output_gate#165| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#136| state)) #b1) #b0 #b1)) ; $procmux$914_Y
(define-fun |output_gate#166| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#100| state) (|output_gate#165| state) #b0)) ; $procmux$916_Y
(define-fun |output_gate#167| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#5| state)) #b1) (|output_gate#166| state) #b0)) ; \stop_is_kept_EN
(define-fun |output_gate_n stop_is_kept_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#167| state)) #b1))
(define-fun |output_gate#168| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#5| state)) #b1) (|output_gate#165| state) #b0)) ; \stopped_is_off_EN
(define-fun |output_gate_n stopped_is_off_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#168| state)) #b1))
(define-fun |output_gate_n stopping_o| ((state |output_gate_s|)) Bool (|output_gate#79| state))
(define-fun |output_gate_n supply_has_settled_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#109| state)) #b1))
(define-fun |output_gate_n temperature_good_i| ((state |output_gate_s|)) Bool (|output_gate#47| state))
(declare-fun |output_gate#169| (|output_gate_s|) (_ BitVec 1)) ; \underrun_1_q
(define-fun |output_gate_n underrun_1_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#169| state)) #b1))
(define-fun |output_gate_n underrun_i| ((state |output_gate_s|)) Bool (|output_gate#50| state))
(define-fun |output_gate#170| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#169| state)) #b1) #b1 #b0)) ; $procmux$888_Y
(define-fun |output_gate#171| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#100| state) (|output_gate#170| state) #b0)) ; $procmux$890_Y
(define-fun |output_gate#172| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#5| state)) #b1) (|output_gate#171| state) #b0)) ; \underrun_is_kept_EN
(define-fun |output_gate_n underrun_is_kept_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#172| state)) #b1))
(define-fun |output_gate#173| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#5| state)) #b1) (|output_gate#170| state) #b0)) ; \underrun_is_off_EN
(define-fun |output_gate_n underrun_is_off_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#173| state)) #b1))
(declare-fun |output_gate#174| (|output_gate_s|) (_ BitVec 32)) ; \underruns_q
(define-fun |output_gate_n underruns_o| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#174| state))
(define-fun |output_gate_n underruns_q| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#174| state))
(declare-fun |output_gate#175| (|output_gate_s|) (_ BitVec 32)) ; \unfed_q
(define-fun |output_gate_n unfed_q| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#175| state))
(declare-fun |output_gate#176| (|output_gate_s|) (_ BitVec 17)) ; \up_q
(define-fun |output_gate_n up_q| ((state |output_gate_s|)) (_ BitVec 17) (|output_gate#176| state))
(define-fun |output_gate_n wrong| ((state |output_gate_s|)) Bool (|output_gate#132| state))
(define-fun |output_gate#177| ((state |output_gate_s|)) (_ BitVec 1) (bvnot (ite (|output_gate#57| state) #b1 #b0))) ; $auto$rtlil.cc:3245:Not$1316
(define-fun |output_gate_u 0| ((state |output_gate_s|)) Bool (or (= ((_ extract 0 0) (|output_gate#177| state)) #b1) (not true))) ; $auto$formalff.cc:987:execute$1317
(define-fun |output_gate#178| ((state |output_gate_s|)) Bool (bvule (|output_gate#15| state) #b01111010000100100)) ; $le$output_gate_properties.vh:119$296_Y
(define-fun |output_gate#179| ((state |output_gate_s|)) Bool (bvule (|output_gate#11| state) #b01111010000100100)) ; $le$output_gate_properties.vh:119$297_Y
(define-fun |output_gate#180| ((state |output_gate_s|)) Bool (and (or  (|output_gate#178| state) false) (or  (|output_gate#179| state) false))) ; $logic_and$output_gate_properties.vh:119$298_Y
(define-fun |output_gate#181| ((state |output_gate_s|)) Bool (bvule (|output_gate#12| state) #b01111010000100100)) ; $le$output_gate_properties.vh:119$299_Y
(define-fun |output_gate#182| ((state |output_gate_s|)) Bool (and (or  (|output_gate#180| state) false) (or  (|output_gate#181| state) false))) ; $logic_and$output_gate_properties.vh:119$300_Y
(define-fun |output_gate#183| ((state |output_gate_s|)) Bool (bvule (|output_gate#13| state) #b01111010000100100)) ; $le$output_gate_properties.vh:119$301_Y
(define-fun |output_gate#184| ((state |output_gate_s|)) Bool (and (or  (|output_gate#182| state) false) (or  (|output_gate#183| state) false))) ; $logic_and$output_gate_properties.vh:119$302_Y
(define-fun |output_gate#185| ((state |output_gate_s|)) Bool (bvule (|output_gate#14| state) #b01111010000100100)) ; $le$output_gate_properties.vh:119$303_Y
(define-fun |output_gate#186| ((state |output_gate_s|)) Bool (and (or  (|output_gate#184| state) false) (or  (|output_gate#185| state) false))) ; $logic_and$output_gate_properties.vh:119$304_Y
(define-fun |output_gate_a 0| ((state |output_gate_s|)) Bool (or (|output_gate#186| state) (not (= ((_ extract 0 0) (|output_gate#107| state)) #b1)))) ; _witness_.assert_assert_output_gate_properties_vh_119_295
(define-fun |output_gate#187| ((state |output_gate_s|)) Bool (bvule (|output_gate#176| state) #b01111010000100100)) ; $le$output_gate_properties.vh:120$306_Y
(define-fun |output_gate_a 1| ((state |output_gate_s|)) Bool (or (|output_gate#187| state) (not (= ((_ extract 0 0) (|output_gate#107| state)) #b1)))) ; _witness_.assert_assert_output_gate_properties_vh_120_305
(define-fun |output_gate#188| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#89| state)) #b1) (= ((_ extract 1 1) (|output_gate#89| state)) #b1) (= ((_ extract 2 2) (|output_gate#89| state)) #b1) (= ((_ extract 3 3) (|output_gate#89| state)) #b1) (= ((_ extract 4 4) (|output_gate#89| state)) #b1) (= ((_ extract 5 5) (|output_gate#89| state)) #b1) (= ((_ extract 6 6) (|output_gate#89| state)) #b1) (= ((_ extract 7 7) (|output_gate#89| state)) #b1) (= ((_ extract 8 8) (|output_gate#89| state)) #b1)))) ; $eq$output_gate_properties.vh:124$318_Y
(define-fun |output_gate#189| ((state |output_gate_s|)) Bool (and (or  (|output_gate#188| state) false) (or  (= ((_ extract 0 0) (|output_gate#20| state)) #b1) false))) ; $logic_and$output_gate_properties.vh:124$319_Y
(define-fun |output_gate#190| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#42| state)) #b1) #b1 #b0)) ; $procmux$750_Y
(define-fun |output_gate#191| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#21| state)) #b1) #b0 (|output_gate#190| state))) ; $procmux$752_Y
(define-fun |output_gate#192| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#5| state)) #b1) (|output_gate#191| state) #b0)) ; $assert$output_gate_properties.vh:124$317_EN
(define-fun |output_gate_a 2| ((state |output_gate_s|)) Bool (or (|output_gate#189| state) (not (= ((_ extract 0 0) (|output_gate#192| state)) #b1)))) ; _witness_.assert_assert_output_gate_properties_vh_124_317
(define-fun |output_gate#193| ((state |output_gate_s|)) Bool (distinct (|output_gate#175| state) #b00000000000000000000000000000000)) ; $ne$output_gate_properties.vh:125$322_Y
(define-fun |output_gate#194| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 0 0) (|output_gate#92| state)) #b1) false) (or  (|output_gate#193| state) false))) ; $logic_and$output_gate_properties.vh:125$323_Y
(define-fun |output_gate_a 3| ((state |output_gate_s|)) Bool (or (|output_gate#194| state) (not (= ((_ extract 0 0) (|output_gate#158| state)) #b1)))) ; _witness_.assert_assert_output_gate_properties_vh_125_321
(define-fun |output_gate#195| ((state |output_gate_s|)) (_ BitVec 33) (bvadd (concat #b0 (|output_gate#93| state)) #b000000000000000000000000000000001)) ; $add$output_gate_properties.vh:108$264_Y
(define-fun |output_gate#196| ((state |output_gate_s|)) Bool (bvule (concat #b0 (|output_gate#175| state)) (|output_gate#195| state))) ; $le$output_gate_properties.vh:108$265_Y
(define-fun |output_gate#197| ((state |output_gate_s|)) Bool (bvule (|output_gate#175| state) #b00000000000000000000000000000010)) ; $le$output_gate_properties.vh:108$266_Y
(define-fun |output_gate#198| ((state |output_gate_s|)) Bool (or  (|output_gate#196| state) false  (|output_gate#197| state) false)) ; $logic_or$output_gate_properties.vh:108$267_Y
(define-fun |output_gate#199| ((state |output_gate_s|)) Bool (and (or  (|output_gate#194| state) false) (or  (|output_gate#198| state) false))) ; $logic_and$output_gate_properties.vh:128$342_Y
(define-fun |output_gate_a 4| ((state |output_gate_s|)) Bool (or (|output_gate#199| state) (not (= ((_ extract 0 0) (|output_gate#192| state)) #b1)))) ; _witness_.assert_assert_output_gate_properties_vh_128_335
(define-fun |output_gate#200| ((state |output_gate_s|)) Bool (= (|output_gate#11| state) #b01111010000100100)) ; $eq$output_gate_properties.vh:131$350_Y
(define-fun |output_gate#201| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 0 0) (|output_gate#119| state)) #b1) false) (or  (|output_gate#200| state) false))) ; $logic_and$output_gate_properties.vh:131$351_Y
(define-fun |output_gate#202| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#110| state)) #b1) #b1 #b0)) ; $procmux$726_Y
(define-fun |output_gate#203| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#21| state)) #b1) #b0 (|output_gate#202| state))) ; $procmux$728_Y
(define-fun |output_gate#204| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#5| state)) #b1) (|output_gate#203| state) #b0)) ; $assert$output_gate_properties.vh:131$349_EN
(define-fun |output_gate_a 5| ((state |output_gate_s|)) Bool (or (|output_gate#201| state) (not (= ((_ extract 0 0) (|output_gate#204| state)) #b1)))) ; _witness_.assert_assert_output_gate_properties_vh_131_349
(define-fun |output_gate#205| ((state |output_gate_s|)) Bool (= (|output_gate#12| state) #b01111010000100100)) ; $eq$output_gate_properties.vh:132$353_Y
(define-fun |output_gate#206| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 1 1) (|output_gate#119| state)) #b1) false) (or  (|output_gate#205| state) false))) ; $logic_and$output_gate_properties.vh:132$354_Y
(define-fun |output_gate#207| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 1 1) (|output_gate#110| state)) #b1) #b1 #b0)) ; $procmux$718_Y
(define-fun |output_gate#208| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#21| state)) #b1) #b0 (|output_gate#207| state))) ; $procmux$720_Y
(define-fun |output_gate#209| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#5| state)) #b1) (|output_gate#208| state) #b0)) ; $assert$output_gate_properties.vh:132$352_EN
(define-fun |output_gate_a 6| ((state |output_gate_s|)) Bool (or (|output_gate#206| state) (not (= ((_ extract 0 0) (|output_gate#209| state)) #b1)))) ; _witness_.assert_assert_output_gate_properties_vh_132_352
(define-fun |output_gate#210| ((state |output_gate_s|)) Bool (= (|output_gate#13| state) #b01111010000100100)) ; $eq$output_gate_properties.vh:133$356_Y
(define-fun |output_gate#211| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 2 2) (|output_gate#119| state)) #b1) false) (or  (|output_gate#210| state) false))) ; $logic_and$output_gate_properties.vh:133$357_Y
(define-fun |output_gate#212| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 2 2) (|output_gate#110| state)) #b1) #b1 #b0)) ; $procmux$710_Y
(define-fun |output_gate#213| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#21| state)) #b1) #b0 (|output_gate#212| state))) ; $procmux$712_Y
(define-fun |output_gate#214| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#5| state)) #b1) (|output_gate#213| state) #b0)) ; $assert$output_gate_properties.vh:133$355_EN
(define-fun |output_gate_a 7| ((state |output_gate_s|)) Bool (or (|output_gate#211| state) (not (= ((_ extract 0 0) (|output_gate#214| state)) #b1)))) ; _witness_.assert_assert_output_gate_properties_vh_133_355
(define-fun |output_gate#215| ((state |output_gate_s|)) (_ BitVec 17) (bvadd (|output_gate#11| state) #b00000000000000001)) ; $add$output_gate_properties.vh:14$366_Y
(define-fun |output_gate#216| ((state |output_gate_s|)) (_ BitVec 17) (ite (|output_gate#200| state) #b01111010000100100 (|output_gate#215| state))) ; $ternary$output_gate_properties.vh:14$367_Y
(define-fun |output_gate#217| ((state |output_gate_s|)) Bool (= (|output_gate#15| state) (|output_gate#216| state))) ; $eq$output_gate_properties.vh:135$369_Y
(define-fun |output_gate#218| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 0 0) (|output_gate#119| state)) #b1) false) (or  (|output_gate#217| state) false))) ; $logic_and$output_gate_properties.vh:135$370_Y
(define-fun |output_gate#219| ((state |output_gate_s|)) Bool (distinct (|output_gate#15| state) #b00000000000000000)) ; $ne$output_gate_properties.vh:135$361_Y
(define-fun |output_gate#220| ((state |output_gate_s|)) Bool (and (or  (|output_gate#83| state) false) (or  (|output_gate#219| state) false))) ; $logic_and$output_gate_properties.vh:135$362_Y
(define-fun |output_gate#221| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#220| state) #b1 #b0)) ; $procmux$694_Y
(define-fun |output_gate#222| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#21| state)) #b1) #b0 (|output_gate#221| state))) ; $procmux$696_Y
(define-fun |output_gate#223| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#5| state)) #b1) (|output_gate#222| state) #b0)) ; $assert$output_gate_properties.vh:135$368_EN
(define-fun |output_gate_a 8| ((state |output_gate_s|)) Bool (or (|output_gate#218| state) (not (= ((_ extract 0 0) (|output_gate#223| state)) #b1)))) ; _witness_.assert_assert_output_gate_properties_vh_135_368
(define-fun |output_gate#224| ((state |output_gate_s|)) (_ BitVec 17) (bvadd (|output_gate#12| state) #b00000000000000001)) ; $add$output_gate_properties.vh:14$376_Y
(define-fun |output_gate#225| ((state |output_gate_s|)) (_ BitVec 17) (ite (|output_gate#205| state) #b01111010000100100 (|output_gate#224| state))) ; $ternary$output_gate_properties.vh:14$377_Y
(define-fun |output_gate#226| ((state |output_gate_s|)) Bool (= (|output_gate#11| state) (|output_gate#225| state))) ; $eq$output_gate_properties.vh:136$379_Y
(define-fun |output_gate#227| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 1 1) (|output_gate#119| state)) #b1) false) (or  (|output_gate#226| state) false))) ; $logic_and$output_gate_properties.vh:136$380_Y
(define-fun |output_gate#228| ((state |output_gate_s|)) Bool (distinct (|output_gate#11| state) #b00000000000000000)) ; $ne$output_gate_properties.vh:136$371_Y
(define-fun |output_gate#229| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 0 0) (|output_gate#119| state)) #b1) false) (or  (|output_gate#228| state) false))) ; $logic_and$output_gate_properties.vh:136$372_Y
(define-fun |output_gate#230| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#229| state) #b1 #b0)) ; $procmux$685_Y
(define-fun |output_gate#231| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#21| state)) #b1) #b0 (|output_gate#230| state))) ; $procmux$687_Y
(define-fun |output_gate#232| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#5| state)) #b1) (|output_gate#231| state) #b0)) ; $assert$output_gate_properties.vh:136$378_EN
(define-fun |output_gate_a 9| ((state |output_gate_s|)) Bool (or (|output_gate#227| state) (not (= ((_ extract 0 0) (|output_gate#232| state)) #b1)))) ; _witness_.assert_assert_output_gate_properties_vh_136_378
(define-fun |output_gate#233| ((state |output_gate_s|)) (_ BitVec 17) (bvadd (|output_gate#13| state) #b00000000000000001)) ; $add$output_gate_properties.vh:14$386_Y
(define-fun |output_gate#234| ((state |output_gate_s|)) (_ BitVec 17) (ite (|output_gate#210| state) #b01111010000100100 (|output_gate#233| state))) ; $ternary$output_gate_properties.vh:14$387_Y
(define-fun |output_gate#235| ((state |output_gate_s|)) Bool (= (|output_gate#12| state) (|output_gate#234| state))) ; $eq$output_gate_properties.vh:137$389_Y
(define-fun |output_gate#236| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 2 2) (|output_gate#119| state)) #b1) false) (or  (|output_gate#235| state) false))) ; $logic_and$output_gate_properties.vh:137$390_Y
(define-fun |output_gate#237| ((state |output_gate_s|)) Bool (distinct (|output_gate#12| state) #b00000000000000000)) ; $ne$output_gate_properties.vh:137$381_Y
(define-fun |output_gate#238| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 1 1) (|output_gate#119| state)) #b1) false) (or  (|output_gate#237| state) false))) ; $logic_and$output_gate_properties.vh:137$382_Y
(define-fun |output_gate#239| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#238| state) #b1 #b0)) ; $procmux$676_Y
(define-fun |output_gate#240| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#21| state)) #b1) #b0 (|output_gate#239| state))) ; $procmux$678_Y
(define-fun |output_gate#241| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#5| state)) #b1) (|output_gate#240| state) #b0)) ; $assert$output_gate_properties.vh:137$388_EN
(define-fun |output_gate_a 10| ((state |output_gate_s|)) Bool (or (|output_gate#236| state) (not (= ((_ extract 0 0) (|output_gate#241| state)) #b1)))) ; _witness_.assert_assert_output_gate_properties_vh_137_388
(define-fun |output_gate#242| ((state |output_gate_s|)) (_ BitVec 17) (bvadd (|output_gate#14| state) #b00000000000000001)) ; $add$output_gate_properties.vh:14$396_Y
(define-fun |output_gate#243| ((state |output_gate_s|)) Bool (= (|output_gate#14| state) #b01111010000100100)) ; $eq$output_gate_properties.vh:134$359_Y
(define-fun |output_gate#244| ((state |output_gate_s|)) (_ BitVec 17) (ite (|output_gate#243| state) #b01111010000100100 (|output_gate#242| state))) ; $ternary$output_gate_properties.vh:14$397_Y
(define-fun |output_gate#245| ((state |output_gate_s|)) Bool (= (|output_gate#13| state) (|output_gate#244| state))) ; $eq$output_gate_properties.vh:138$399_Y
(define-fun |output_gate#246| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 0 0) (|output_gate#25| state)) #b1) false) (or  (|output_gate#245| state) false))) ; $logic_and$output_gate_properties.vh:138$400_Y
(define-fun |output_gate#247| ((state |output_gate_s|)) Bool (distinct (|output_gate#13| state) #b00000000000000000)) ; $ne$output_gate_properties.vh:138$391_Y
(define-fun |output_gate#248| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 2 2) (|output_gate#119| state)) #b1) false) (or  (|output_gate#247| state) false))) ; $logic_and$output_gate_properties.vh:138$392_Y
(define-fun |output_gate#249| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#248| state) #b1 #b0)) ; $procmux$667_Y
(define-fun |output_gate#250| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#21| state)) #b1) #b0 (|output_gate#249| state))) ; $procmux$669_Y
(define-fun |output_gate#251| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#5| state)) #b1) (|output_gate#250| state) #b0)) ; $assert$output_gate_properties.vh:138$398_EN
(define-fun |output_gate_a 11| ((state |output_gate_s|)) Bool (or (|output_gate#246| state) (not (= ((_ extract 0 0) (|output_gate#251| state)) #b1)))) ; _witness_.assert_assert_output_gate_properties_vh_138_398
(define-fun |output_gate#252| ((state |output_gate_s|)) Bool (bvuge (|output_gate#176| state) (|output_gate#14| state))) ; $ge$output_gate_properties.vh:139$402_Y
(define-fun |output_gate#253| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#25| state)) #b1) #b1 #b0)) ; $procmux$658_Y
(define-fun |output_gate#254| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#21| state)) #b1) #b0 (|output_gate#253| state))) ; $procmux$660_Y
(define-fun |output_gate#255| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#5| state)) #b1) (|output_gate#254| state) #b0)) ; $assert$output_gate_properties.vh:139$401_EN
(define-fun |output_gate_a 12| ((state |output_gate_s|)) Bool (or (|output_gate#252| state) (not (= ((_ extract 0 0) (|output_gate#255| state)) #b1)))) ; _witness_.assert_assert_output_gate_properties_vh_139_401
(define-fun |output_gate#256| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#89| state)) #b1) (= ((_ extract 1 1) (|output_gate#89| state)) #b1) (= ((_ extract 2 2) (|output_gate#89| state)) #b1) (= ((_ extract 3 3) (|output_gate#89| state)) #b1) (= ((_ extract 4 4) (|output_gate#89| state)) #b1) (= ((_ extract 5 5) (|output_gate#89| state)) #b1) (= ((_ extract 6 6) (|output_gate#89| state)) #b1) (= ((_ extract 7 7) (|output_gate#89| state)) #b1) (= ((_ extract 8 8) (|output_gate#89| state)) #b1) false false false false false false false))) ; $eq$output_gate_properties.vh:106$258_Y
(define-fun |output_gate#257| ((state |output_gate_s|)) Bool (and (or  (|output_gate#84| state) false) (or  (|output_gate#256| state) false))) ; $logic_and$output_gate_properties.vh:30$97_Y
(define-fun |output_gate#258| ((state |output_gate_s|)) Bool (and (or  (|output_gate#257| state) false) (or  (|output_gate#43| state) false))) ; $logic_and$output_gate_properties.vh:30$98_Y
(define-fun |output_gate#259| ((state |output_gate_s|)) Bool (and (or  (|output_gate#258| state) false) (or  (|output_gate#47| state) false))) ; $logic_and$output_gate_properties.vh:30$99_Y
(define-fun |output_gate#260| ((state |output_gate_s|)) Bool (and (or  (|output_gate#259| state) false) (or  (|output_gate#95| state) false))) ; $logic_and$output_gate_properties.vh:30$100_Y
(define-fun |output_gate#261| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#34| state) #b1 #b0)) ; $assume$output_gate_properties.vh:30$95_EN
(define-fun |output_gate_u 1| ((state |output_gate_s|)) Bool (or (|output_gate#260| state) (not (= ((_ extract 0 0) (|output_gate#261| state)) #b1)))) ; _witness_.assume_assume_output_gate_properties_vh_30_95
(define-fun |output_gate#262| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#21| state)) #b1) false))) ; $logic_not$output_gate_properties.vh:31$102_Y
(define-fun |output_gate#263| ((state |output_gate_s|)) Bool (or  (|output_gate#262| state) false  (|output_gate#149| state) false)) ; $logic_or$output_gate_properties.vh:31$103_Y
(define-fun |output_gate_u 2| ((state |output_gate_s|)) Bool (or (|output_gate#263| state) (not true))) ; _witness_.assume_assume_output_gate_properties_vh_31_101
(define-fun |output_gate#264| ((state |output_gate_s|)) Bool (|output_gate_is| state)) ; $auto$rtlil.cc:3293:And$1028
(define-fun |output_gate_u 3| ((state |output_gate_s|)) Bool (or (|output_gate#149| state) (not (|output_gate#264| state)))) ; _witness_.assume_assume_output_gate_properties_vh_34_405
(define-fun |output_gate#265| ((state |output_gate_s|)) (_ BitVec 32) (bvadd (|output_gate#87| state) #b00000000000000000000000000000001)) ; $add$output_gate_properties.vh:100$240_Y
(define-fun |output_gate#266| ((state |output_gate_s|)) Bool (= (|output_gate#88| state) (|output_gate#265| state))) ; $eq$output_gate_properties.vh:100$241_Y
(define-fun |output_gate#267| ((state |output_gate_s|)) Bool (= (|output_gate#90| state) (|output_gate#117| state))) ; $eq$output_gate_properties.vh:100$242_Y
(define-fun |output_gate#268| ((state |output_gate_s|)) Bool (and (or  (|output_gate#266| state) false) (or  (|output_gate#267| state) false))) ; $logic_and$output_gate_properties.vh:100$243_Y
(define-fun |output_gate_a 13| ((state |output_gate_s|)) Bool (or (|output_gate#268| state) (not (= ((_ extract 0 0) (|output_gate#6| state)) #b1)))) ; a_fault_is_counted
(define-fun |output_gate#269| ((state |output_gate_s|)) Bool (distinct ((_ extract 8 4) (|output_gate#89| state)) #b00000)) ; $ne$output_gate_properties.vh:110$270_Y
(define-fun |output_gate_a 14| ((state |output_gate_s|)) Bool (or (|output_gate#269| state) (not (= ((_ extract 0 0) (|output_gate#10| state)) #b1)))) ; a_limit_rests
(define-fun |output_gate#270| ((state |output_gate_s|)) Bool (not (or  (|output_gate#32| state) false))) ; $logic_not$output_gate_properties.vh:79$203_Y
(define-fun |output_gate_a 15| ((state |output_gate_s|)) Bool (or (|output_gate#270| state) (not (= ((_ extract 0 0) (|output_gate#40| state)) #b1)))) ; beyond_is_off
(define-fun |output_gate#271| ((state |output_gate_s|)) Bool (or  (|output_gate#84| state) false  (|output_gate#79| state) false)) ; $logic_or$output_gate_properties.vh:102$255_Y
(define-fun |output_gate#272| ((state |output_gate_s|)) Bool (or  (|output_gate#271| state) false  (|output_gate#81| state) false)) ; $logic_or$output_gate_properties.vh:102$257_Y
(define-fun |output_gate_a 16| ((state |output_gate_s|)) Bool (or (|output_gate#272| state) (not (= ((_ extract 0 0) (|output_gate#65| state)) #b1)))) ; disarm_is_obeyed
(define-fun |output_gate_a 17| ((state |output_gate_s|)) Bool (or (|output_gate#272| state) (not (= ((_ extract 0 0) (|output_gate#68| state)) #b1)))) ; disarmed_for_good
(define-fun |output_gate#273| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 0 0) (|output_gate#25| state)) #b1) false) (or  (|output_gate#243| state) false))) ; $logic_and$output_gate_properties.vh:134$360_Y
(define-fun |output_gate_a 18| ((state |output_gate_s|)) Bool (or (|output_gate#273| state) (not (= ((_ extract 0 0) (|output_gate#73| state)) #b1)))) ; edges_once_settled
(define-fun |output_gate_a 19| ((state |output_gate_s|)) Bool (or (= ((_ extract 2 2) (|output_gate#89| state)) #b1) (not (= ((_ extract 0 0) (|output_gate#102| state)) #b1)))) ; heat_is_kept
(define-fun |output_gate_a 20| ((state |output_gate_s|)) Bool (or (|output_gate#270| state) (not (= ((_ extract 0 0) (|output_gate#103| state)) #b1)))) ; hot_is_off
(define-fun |output_gate#274| ((state |output_gate_s|)) (_ BitVec 32) (bvnot (concat #b000000000000000000000000000 ((_ extract 8 4) (|output_gate#89| state))))) ; $not$output_gate_properties.vh:111$274_Y
(define-fun |output_gate#275| ((state |output_gate_s|)) (_ BitVec 32) (bvand (concat #b000000000000000000000000000 (|output_gate#37| state)) (|output_gate#274| state))) ; $and$output_gate_properties.vh:95$232_Y
(define-fun |output_gate#276| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#275| state)) #b1) (= ((_ extract 1 1) (|output_gate#275| state)) #b1) (= ((_ extract 2 2) (|output_gate#275| state)) #b1) (= ((_ extract 3 3) (|output_gate#275| state)) #b1) (= ((_ extract 4 4) (|output_gate#275| state)) #b1) (= ((_ extract 5 5) (|output_gate#275| state)) #b1) (= ((_ extract 6 6) (|output_gate#275| state)) #b1) (= ((_ extract 7 7) (|output_gate#275| state)) #b1) (= ((_ extract 8 8) (|output_gate#275| state)) #b1) (= ((_ extract 9 9) (|output_gate#275| state)) #b1) (= ((_ extract 10 10) (|output_gate#275| state)) #b1) (= ((_ extract 11 11) (|output_gate#275| state)) #b1) (= ((_ extract 12 12) (|output_gate#275| state)) #b1) (= ((_ extract 13 13) (|output_gate#275| state)) #b1) (= ((_ extract 14 14) (|output_gate#275| state)) #b1) (= ((_ extract 15 15) (|output_gate#275| state)) #b1) (= ((_ extract 16 16) (|output_gate#275| state)) #b1) (= ((_ extract 17 17) (|output_gate#275| state)) #b1) (= ((_ extract 18 18) (|output_gate#275| state)) #b1) (= ((_ extract 19 19) (|output_gate#275| state)) #b1) (= ((_ extract 20 20) (|output_gate#275| state)) #b1) (= ((_ extract 21 21) (|output_gate#275| state)) #b1) (= ((_ extract 22 22) (|output_gate#275| state)) #b1) (= ((_ extract 23 23) (|output_gate#275| state)) #b1) (= ((_ extract 24 24) (|output_gate#275| state)) #b1) (= ((_ extract 25 25) (|output_gate#275| state)) #b1) (= ((_ extract 26 26) (|output_gate#275| state)) #b1) (= ((_ extract 27 27) (|output_gate#275| state)) #b1) (= ((_ extract 28 28) (|output_gate#275| state)) #b1) (= ((_ extract 29 29) (|output_gate#275| state)) #b1) (= ((_ extract 30 30) (|output_gate#275| state)) #b1) (= ((_ extract 31 31) (|output_gate#275| state)) #b1)))) ; $eq$output_gate_properties.vh:95$233_Y
(define-fun |output_gate_a 21| ((state |output_gate_s|)) Bool (or (|output_gate#276| state) (not (= ((_ extract 0 0) (|output_gate#105| state)) #b1)))) ; limits_are_kept
(define-fun |output_gate#277| ((state |output_gate_s|)) Bool (distinct (|output_gate#119| state) #b000)) ; $ne$output_gate.v:133$57_Y
(define-fun |output_gate#278| ((state |output_gate_s|)) Bool (or  (|output_gate#83| state) false  (|output_gate#277| state) false)) ; $logic_or$output_gate.v:133$58_Y
(define-fun |output_gate#279| ((state |output_gate_s|)) Bool (or  (|output_gate#278| state) false  (= ((_ extract 0 0) (|output_gate#25| state)) #b1) false)) ; $logic_or$output_gate_properties.vh:123$315_Y
(define-fun |output_gate#280| ((state |output_gate_s|)) Bool (= (|output_gate#42| state) (ite (|output_gate#279| state) #b1 #b0))) ; $eq$output_gate_properties.vh:123$316_Y
(define-fun |output_gate_a 22| ((state |output_gate_s|)) Bool (or (|output_gate#280| state) (not (= ((_ extract 0 0) (|output_gate#107| state)) #b1)))) ; live_is_anything_on
(define-fun |output_gate#281| ((state |output_gate_s|)) (_ BitVec 32) (bvnot (|output_gate#108| state))) ; $not$output_gate_properties.vh:87$220_Y
(define-fun |output_gate#282| ((state |output_gate_s|)) (_ BitVec 32) (bvand (|output_gate#22| state) (|output_gate#281| state))) ; $and$output_gate_properties.vh:87$221_Y
(define-fun |output_gate#283| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#282| state)) #b1) (= ((_ extract 1 1) (|output_gate#282| state)) #b1) (= ((_ extract 2 2) (|output_gate#282| state)) #b1) (= ((_ extract 3 3) (|output_gate#282| state)) #b1) (= ((_ extract 4 4) (|output_gate#282| state)) #b1) (= ((_ extract 5 5) (|output_gate#282| state)) #b1) (= ((_ extract 6 6) (|output_gate#282| state)) #b1) (= ((_ extract 7 7) (|output_gate#282| state)) #b1) (= ((_ extract 8 8) (|output_gate#282| state)) #b1) (= ((_ extract 9 9) (|output_gate#282| state)) #b1) (= ((_ extract 10 10) (|output_gate#282| state)) #b1) (= ((_ extract 11 11) (|output_gate#282| state)) #b1) (= ((_ extract 12 12) (|output_gate#282| state)) #b1) (= ((_ extract 13 13) (|output_gate#282| state)) #b1) (= ((_ extract 14 14) (|output_gate#282| state)) #b1) (= ((_ extract 15 15) (|output_gate#282| state)) #b1) (= ((_ extract 16 16) (|output_gate#282| state)) #b1) (= ((_ extract 17 17) (|output_gate#282| state)) #b1) (= ((_ extract 18 18) (|output_gate#282| state)) #b1) (= ((_ extract 19 19) (|output_gate#282| state)) #b1) (= ((_ extract 20 20) (|output_gate#282| state)) #b1) (= ((_ extract 21 21) (|output_gate#282| state)) #b1) (= ((_ extract 22 22) (|output_gate#282| state)) #b1) (= ((_ extract 23 23) (|output_gate#282| state)) #b1) (= ((_ extract 24 24) (|output_gate#282| state)) #b1) (= ((_ extract 25 25) (|output_gate#282| state)) #b1) (= ((_ extract 26 26) (|output_gate#282| state)) #b1) (= ((_ extract 27 27) (|output_gate#282| state)) #b1) (= ((_ extract 28 28) (|output_gate#282| state)) #b1) (= ((_ extract 29 29) (|output_gate#282| state)) #b1) (= ((_ extract 30 30) (|output_gate#282| state)) #b1) (= ((_ extract 31 31) (|output_gate#282| state)) #b1)))) ; $eq$output_gate_properties.vh:87$222_Y
(define-fun |output_gate_a 23| ((state |output_gate_s|)) Bool (or (|output_gate#283| state) (not (= ((_ extract 0 0) (|output_gate#109| state)) #b1)))) ; mask_is_kept
(define-fun |output_gate#284| ((state |output_gate_s|)) Bool (= (|output_gate#15| state) #b01111010000100100)) ; $eq$output_gate_properties.vh:130$348_Y
(define-fun |output_gate_a 24| ((state |output_gate_s|)) Bool (or (|output_gate#284| state) (not (= ((_ extract 0 0) (|output_gate#113| state)) #b1)))) ; moves_once_settled
(define-fun |output_gate#285| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#22| state)) #b1) (= ((_ extract 1 1) (|output_gate#22| state)) #b1) (= ((_ extract 2 2) (|output_gate#22| state)) #b1) (= ((_ extract 3 3) (|output_gate#22| state)) #b1) (= ((_ extract 4 4) (|output_gate#22| state)) #b1) (= ((_ extract 5 5) (|output_gate#22| state)) #b1) (= ((_ extract 6 6) (|output_gate#22| state)) #b1) (= ((_ extract 7 7) (|output_gate#22| state)) #b1) (= ((_ extract 8 8) (|output_gate#22| state)) #b1) (= ((_ extract 9 9) (|output_gate#22| state)) #b1) (= ((_ extract 10 10) (|output_gate#22| state)) #b1) (= ((_ extract 11 11) (|output_gate#22| state)) #b1) (= ((_ extract 12 12) (|output_gate#22| state)) #b1) (= ((_ extract 13 13) (|output_gate#22| state)) #b1) (= ((_ extract 14 14) (|output_gate#22| state)) #b1) (= ((_ extract 15 15) (|output_gate#22| state)) #b1) (= ((_ extract 16 16) (|output_gate#22| state)) #b1) (= ((_ extract 17 17) (|output_gate#22| state)) #b1) (= ((_ extract 18 18) (|output_gate#22| state)) #b1) (= ((_ extract 19 19) (|output_gate#22| state)) #b1) (= ((_ extract 20 20) (|output_gate#22| state)) #b1) (= ((_ extract 21 21) (|output_gate#22| state)) #b1) (= ((_ extract 22 22) (|output_gate#22| state)) #b1) (= ((_ extract 23 23) (|output_gate#22| state)) #b1) (= ((_ extract 24 24) (|output_gate#22| state)) #b1) (= ((_ extract 25 25) (|output_gate#22| state)) #b1) (= ((_ extract 26 26) (|output_gate#22| state)) #b1) (= ((_ extract 27 27) (|output_gate#22| state)) #b1) (= ((_ extract 28 28) (|output_gate#22| state)) #b1) (= ((_ extract 29 29) (|output_gate#22| state)) #b1) (= ((_ extract 30 30) (|output_gate#22| state)) #b1) (= ((_ extract 31 31) (|output_gate#22| state)) #b1)))) ; $eq$output_gate_properties.vh:113$277_Y
(define-fun |output_gate#286| ((state |output_gate_s|)) Bool (or  (|output_gate#285| state) false  (= ((_ extract 0 0) (|output_gate#25| state)) #b1) false)) ; $logic_or$output_gate_properties.vh:113$278_Y
(define-fun |output_gate_a 25| ((state |output_gate_s|)) Bool (or (|output_gate#286| state) (not (= ((_ extract 0 0) (|output_gate#109| state)) #b1)))) ; no_channel_alone
(define-fun |output_gate#287| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#25| state)) #b1) false))) ; $logic_not$output_gate_properties.vh:38$106_Y
(define-fun |output_gate#288| ((state |output_gate_s|)) Bool (and (or  (|output_gate#285| state) false) (or  (|output_gate#287| state) false))) ; $logic_and$output_gate_properties.vh:38$107_Y
(define-fun |output_gate#289| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#28| state)) #b1) false))) ; $logic_not$output_gate_properties.vh:114$279_Y
(define-fun |output_gate#290| ((state |output_gate_s|)) Bool (and (or  (|output_gate#288| state) false) (or  (|output_gate#289| state) false))) ; $logic_and$output_gate_properties.vh:38$109_Y
(define-fun |output_gate#291| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#31| state)) #b1) false))) ; $logic_not$output_gate_properties.vh:114$280_Y
(define-fun |output_gate#292| ((state |output_gate_s|)) Bool (and (or  (|output_gate#290| state) false) (or  (|output_gate#291| state) false))) ; $logic_and$output_gate_properties.vh:38$111_Y
(define-fun |output_gate_a 26| ((state |output_gate_s|)) Bool (or (|output_gate#292| state) (not (= ((_ extract 0 0) (|output_gate#114| state)) #b1)))) ; no_clock_is_off
(define-fun |output_gate#293| ((state |output_gate_s|)) Bool (and (or  (|output_gate#289| state) false) (or  (|output_gate#291| state) false))) ; $logic_and$output_gate_properties.vh:114$281_Y
(define-fun |output_gate#294| ((state |output_gate_s|)) Bool (or  (= ((_ extract 0 0) (|output_gate#25| state)) #b1) false  (|output_gate#293| state) false)) ; $logic_or$output_gate_properties.vh:114$282_Y
(define-fun |output_gate_a 27| ((state |output_gate_s|)) Bool (or (|output_gate#294| state) (not (= ((_ extract 0 0) (|output_gate#109| state)) #b1)))) ; no_sign_of_life_alone
(define-fun |output_gate_a 28| ((state |output_gate_s|)) Bool (or (|output_gate#270| state) (not (= ((_ extract 0 0) (|output_gate#116| state)) #b1)))) ; nonsense_is_off
(define-fun |output_gate_a 29| ((state |output_gate_s|)) Bool (or (= ((_ extract 0 0) (|output_gate#20| state)) #b1) (not (= ((_ extract 0 0) (|output_gate#121| state)) #b1)))) ; on_once_armed
(define-fun |output_gate#295| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 0 0) (|output_gate#92| state)) #b1) false) (or  (|output_gate#198| state) false))) ; $logic_and$output_gate_properties.vh:108$268_Y
(define-fun |output_gate_a 30| ((state |output_gate_s|)) Bool (or (|output_gate#295| state) (not (= ((_ extract 0 0) (|output_gate#121| state)) #b1)))) ; on_while_fed
(define-fun |output_gate_a 31| ((state |output_gate_s|)) Bool (or (|output_gate#256| state) (not (= ((_ extract 0 0) (|output_gate#121| state)) #b1)))) ; on_without_fault
(define-fun |output_gate#296| ((state |output_gate_s|)) (_ BitVec 32) (bvnot (concat #b00000000000000000000000 (|output_gate#89| state)))) ; $not$output_gate_properties.vh:99$237_Y
(define-fun |output_gate#297| ((state |output_gate_s|)) (_ BitVec 32) (bvand (concat #b0000000000000000 (|output_gate#19| state)) (|output_gate#296| state))) ; $and$output_gate_properties.vh:99$238_Y
(define-fun |output_gate#298| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#297| state)) #b1) (= ((_ extract 1 1) (|output_gate#297| state)) #b1) (= ((_ extract 2 2) (|output_gate#297| state)) #b1) (= ((_ extract 3 3) (|output_gate#297| state)) #b1) (= ((_ extract 4 4) (|output_gate#297| state)) #b1) (= ((_ extract 5 5) (|output_gate#297| state)) #b1) (= ((_ extract 6 6) (|output_gate#297| state)) #b1) (= ((_ extract 7 7) (|output_gate#297| state)) #b1) (= ((_ extract 8 8) (|output_gate#297| state)) #b1) (= ((_ extract 9 9) (|output_gate#297| state)) #b1) (= ((_ extract 10 10) (|output_gate#297| state)) #b1) (= ((_ extract 11 11) (|output_gate#297| state)) #b1) (= ((_ extract 12 12) (|output_gate#297| state)) #b1) (= ((_ extract 13 13) (|output_gate#297| state)) #b1) (= ((_ extract 14 14) (|output_gate#297| state)) #b1) (= ((_ extract 15 15) (|output_gate#297| state)) #b1) (= ((_ extract 16 16) (|output_gate#297| state)) #b1) (= ((_ extract 17 17) (|output_gate#297| state)) #b1) (= ((_ extract 18 18) (|output_gate#297| state)) #b1) (= ((_ extract 19 19) (|output_gate#297| state)) #b1) (= ((_ extract 20 20) (|output_gate#297| state)) #b1) (= ((_ extract 21 21) (|output_gate#297| state)) #b1) (= ((_ extract 22 22) (|output_gate#297| state)) #b1) (= ((_ extract 23 23) (|output_gate#297| state)) #b1) (= ((_ extract 24 24) (|output_gate#297| state)) #b1) (= ((_ extract 25 25) (|output_gate#297| state)) #b1) (= ((_ extract 26 26) (|output_gate#297| state)) #b1) (= ((_ extract 27 27) (|output_gate#297| state)) #b1) (= ((_ extract 28 28) (|output_gate#297| state)) #b1) (= ((_ extract 29 29) (|output_gate#297| state)) #b1) (= ((_ extract 30 30) (|output_gate#297| state)) #b1) (= ((_ extract 31 31) (|output_gate#297| state)) #b1)))) ; $eq$output_gate_properties.vh:99$239_Y
(define-fun |output_gate_a 32| ((state |output_gate_s|)) Bool (or (|output_gate#298| state) (not (= ((_ extract 0 0) (|output_gate#124| state)) #b1)))) ; only_a_command_clears
(define-fun |output_gate#299| ((state |output_gate_s|)) Bool (= (|output_gate#88| state) (|output_gate#87| state))) ; $eq$output_gate_properties.vh:101$245_Y
(define-fun |output_gate#300| ((state |output_gate_s|)) (_ BitVec 32) (bvnot (concat #b0000000000000000 (|output_gate#19| state)))) ; $not$output_gate_properties.vh:101$247_Y
(define-fun |output_gate#301| ((state |output_gate_s|)) (_ BitVec 32) (bvand (concat #b00000000000000000000000 (|output_gate#89| state)) (|output_gate#300| state))) ; $and$output_gate_properties.vh:101$248_Y
(define-fun |output_gate#302| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#301| state)) #b1) (= ((_ extract 1 1) (|output_gate#301| state)) #b1) (= ((_ extract 2 2) (|output_gate#301| state)) #b1) (= ((_ extract 3 3) (|output_gate#301| state)) #b1) (= ((_ extract 4 4) (|output_gate#301| state)) #b1) (= ((_ extract 5 5) (|output_gate#301| state)) #b1) (= ((_ extract 6 6) (|output_gate#301| state)) #b1) (= ((_ extract 7 7) (|output_gate#301| state)) #b1) (= ((_ extract 8 8) (|output_gate#301| state)) #b1) (= ((_ extract 9 9) (|output_gate#301| state)) #b1) (= ((_ extract 10 10) (|output_gate#301| state)) #b1) (= ((_ extract 11 11) (|output_gate#301| state)) #b1) (= ((_ extract 12 12) (|output_gate#301| state)) #b1) (= ((_ extract 13 13) (|output_gate#301| state)) #b1) (= ((_ extract 14 14) (|output_gate#301| state)) #b1) (= ((_ extract 15 15) (|output_gate#301| state)) #b1) (= ((_ extract 16 16) (|output_gate#301| state)) #b1) (= ((_ extract 17 17) (|output_gate#301| state)) #b1) (= ((_ extract 18 18) (|output_gate#301| state)) #b1) (= ((_ extract 19 19) (|output_gate#301| state)) #b1) (= ((_ extract 20 20) (|output_gate#301| state)) #b1) (= ((_ extract 21 21) (|output_gate#301| state)) #b1) (= ((_ extract 22 22) (|output_gate#301| state)) #b1) (= ((_ extract 23 23) (|output_gate#301| state)) #b1) (= ((_ extract 24 24) (|output_gate#301| state)) #b1) (= ((_ extract 25 25) (|output_gate#301| state)) #b1) (= ((_ extract 26 26) (|output_gate#301| state)) #b1) (= ((_ extract 27 27) (|output_gate#301| state)) #b1) (= ((_ extract 28 28) (|output_gate#301| state)) #b1) (= ((_ extract 29 29) (|output_gate#301| state)) #b1) (= ((_ extract 30 30) (|output_gate#301| state)) #b1) (= ((_ extract 31 31) (|output_gate#301| state)) #b1)))) ; $eq$output_gate_properties.vh:101$249_Y
(define-fun |output_gate#303| ((state |output_gate_s|)) Bool (and (or  (|output_gate#299| state) false) (or  (|output_gate#302| state) false))) ; $logic_and$output_gate_properties.vh:101$250_Y
(define-fun |output_gate_a 33| ((state |output_gate_s|)) Bool (or (|output_gate#303| state) (not (= ((_ extract 0 0) (|output_gate#127| state)) #b1)))) ; only_a_fault_counts
(define-fun |output_gate#304| ((state |output_gate_s|)) (_ BitVec 32) (bvnot (|output_gate#69| state))) ; $not$output_gate_properties.vh:88$223_Y
(define-fun |output_gate#305| ((state |output_gate_s|)) (_ BitVec 32) (bvand (|output_gate#22| state) (|output_gate#304| state))) ; $and$output_gate_properties.vh:88$224_Y
(define-fun |output_gate#306| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#305| state)) #b1) (= ((_ extract 1 1) (|output_gate#305| state)) #b1) (= ((_ extract 2 2) (|output_gate#305| state)) #b1) (= ((_ extract 3 3) (|output_gate#305| state)) #b1) (= ((_ extract 4 4) (|output_gate#305| state)) #b1) (= ((_ extract 5 5) (|output_gate#305| state)) #b1) (= ((_ extract 6 6) (|output_gate#305| state)) #b1) (= ((_ extract 7 7) (|output_gate#305| state)) #b1) (= ((_ extract 8 8) (|output_gate#305| state)) #b1) (= ((_ extract 9 9) (|output_gate#305| state)) #b1) (= ((_ extract 10 10) (|output_gate#305| state)) #b1) (= ((_ extract 11 11) (|output_gate#305| state)) #b1) (= ((_ extract 12 12) (|output_gate#305| state)) #b1) (= ((_ extract 13 13) (|output_gate#305| state)) #b1) (= ((_ extract 14 14) (|output_gate#305| state)) #b1) (= ((_ extract 15 15) (|output_gate#305| state)) #b1) (= ((_ extract 16 16) (|output_gate#305| state)) #b1) (= ((_ extract 17 17) (|output_gate#305| state)) #b1) (= ((_ extract 18 18) (|output_gate#305| state)) #b1) (= ((_ extract 19 19) (|output_gate#305| state)) #b1) (= ((_ extract 20 20) (|output_gate#305| state)) #b1) (= ((_ extract 21 21) (|output_gate#305| state)) #b1) (= ((_ extract 22 22) (|output_gate#305| state)) #b1) (= ((_ extract 23 23) (|output_gate#305| state)) #b1) (= ((_ extract 24 24) (|output_gate#305| state)) #b1) (= ((_ extract 25 25) (|output_gate#305| state)) #b1) (= ((_ extract 26 26) (|output_gate#305| state)) #b1) (= ((_ extract 27 27) (|output_gate#305| state)) #b1) (= ((_ extract 28 28) (|output_gate#305| state)) #b1) (= ((_ extract 29 29) (|output_gate#305| state)) #b1) (= ((_ extract 30 30) (|output_gate#305| state)) #b1) (= ((_ extract 31 31) (|output_gate#305| state)) #b1)))) ; $eq$output_gate_properties.vh:88$225_Y
(define-fun |output_gate_a 34| ((state |output_gate_s|)) Bool (or (|output_gate#306| state) (not (= ((_ extract 0 0) (|output_gate#109| state)) #b1)))) ; only_what_is_played
(define-fun |output_gate#307| ((state |output_gate_s|)) Bool (and (or  (|output_gate#270| state) false) (or  (|output_gate#84| state) false))) ; $logic_and$output_gate_properties.vh:79$205_Y
(define-fun |output_gate#308| ((state |output_gate_s|)) Bool (and (or  (|output_gate#307| state) false) (or  (|output_gate#256| state) false))) ; $logic_and$output_gate_properties.vh:79$207_Y
(define-fun |output_gate#309| ((state |output_gate_s|)) Bool (and (or  (|output_gate#308| state) false) (or  (= ((_ extract 0 0) (|output_gate#17| state)) #b1) false))) ; $logic_and$output_gate_properties.vh:79$209_Y
(define-fun |output_gate_a 35| ((state |output_gate_s|)) Bool (or (|output_gate#309| state) (not (= ((_ extract 0 0) (|output_gate#139| state)) #b1)))) ; reset_is_off
(define-fun |output_gate#310| ((state |output_gate_s|)) Bool (= (|output_gate#140| state) (ite (|output_gate#8| state) #b1 #b0))) ; $eq$output_gate_properties.vh:121$308_Y
(define-fun |output_gate#311| ((state |output_gate_s|)) Bool (bvule (|output_gate#7| state) #b00000000111011100110101100101000)) ; $le$output_gate_properties.vh:121$309_Y
(define-fun |output_gate#312| ((state |output_gate_s|)) Bool (and (or  (|output_gate#310| state) false) (or  (|output_gate#311| state) false))) ; $logic_and$output_gate_properties.vh:121$310_Y
(define-fun |output_gate_a 36| ((state |output_gate_s|)) Bool (or (|output_gate#312| state) (not (= ((_ extract 0 0) (|output_gate#107| state)) #b1)))) ; rest_has_its_time
(define-fun |output_gate#313| ((state |output_gate_s|)) (_ BitVec 32) (bvsub #b00000000111011100110101100101000 (|output_gate#7| state))) ; $sub$output_gate_properties.vh:122$311_Y
(define-fun |output_gate#314| ((state |output_gate_s|)) Bool (= (|output_gate#148| state) (|output_gate#313| state))) ; $eq$output_gate_properties.vh:122$312_Y
(define-fun |output_gate_a 37| ((state |output_gate_s|)) Bool (or (|output_gate#314| state) (not (= ((_ extract 0 0) (|output_gate#143| state)) #b1)))) ; rest_is_counted
(define-fun |output_gate#315| ((state |output_gate_s|)) (_ BitVec 32) (bvand (concat #b000000000000000000000000000 (|output_gate#91| state)) (|output_gate#274| state))) ; $and$output_gate_properties.vh:111$275_Y
(define-fun |output_gate#316| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#315| state)) #b1) (= ((_ extract 1 1) (|output_gate#315| state)) #b1) (= ((_ extract 2 2) (|output_gate#315| state)) #b1) (= ((_ extract 3 3) (|output_gate#315| state)) #b1) (= ((_ extract 4 4) (|output_gate#315| state)) #b1) (= ((_ extract 5 5) (|output_gate#315| state)) #b1) (= ((_ extract 6 6) (|output_gate#315| state)) #b1) (= ((_ extract 7 7) (|output_gate#315| state)) #b1) (= ((_ extract 8 8) (|output_gate#315| state)) #b1) (= ((_ extract 9 9) (|output_gate#315| state)) #b1) (= ((_ extract 10 10) (|output_gate#315| state)) #b1) (= ((_ extract 11 11) (|output_gate#315| state)) #b1) (= ((_ extract 12 12) (|output_gate#315| state)) #b1) (= ((_ extract 13 13) (|output_gate#315| state)) #b1) (= ((_ extract 14 14) (|output_gate#315| state)) #b1) (= ((_ extract 15 15) (|output_gate#315| state)) #b1) (= ((_ extract 16 16) (|output_gate#315| state)) #b1) (= ((_ extract 17 17) (|output_gate#315| state)) #b1) (= ((_ extract 18 18) (|output_gate#315| state)) #b1) (= ((_ extract 19 19) (|output_gate#315| state)) #b1) (= ((_ extract 20 20) (|output_gate#315| state)) #b1) (= ((_ extract 21 21) (|output_gate#315| state)) #b1) (= ((_ extract 22 22) (|output_gate#315| state)) #b1) (= ((_ extract 23 23) (|output_gate#315| state)) #b1) (= ((_ extract 24 24) (|output_gate#315| state)) #b1) (= ((_ extract 25 25) (|output_gate#315| state)) #b1) (= ((_ extract 26 26) (|output_gate#315| state)) #b1) (= ((_ extract 27 27) (|output_gate#315| state)) #b1) (= ((_ extract 28 28) (|output_gate#315| state)) #b1) (= ((_ extract 29 29) (|output_gate#315| state)) #b1) (= ((_ extract 30 30) (|output_gate#315| state)) #b1) (= ((_ extract 31 31) (|output_gate#315| state)) #b1)))) ; $eq$output_gate_properties.vh:111$276_Y
(define-fun |output_gate_a 38| ((state |output_gate_s|)) Bool (or (|output_gate#316| state) (not (= ((_ extract 0 0) (|output_gate#147| state)) #b1)))) ; rest_is_kept
(define-fun |output_gate#317| ((state |output_gate_s|)) Bool (bvult (|output_gate#15| state) #b01111010000100100)) ; $lt$output_gate_properties.vh:129$344_Y
(define-fun |output_gate#318| ((state |output_gate_s|)) (_ BitVec 17) (bvsub #b01111010000100011 (|output_gate#15| state))) ; $sub$output_gate_properties.vh:129$345_Y
(define-fun |output_gate#319| ((state |output_gate_s|)) Bool (= (concat #b0 (|output_gate#150| state)) (|output_gate#318| state))) ; $eq$output_gate_properties.vh:129$346_Y
(define-fun |output_gate#320| ((state |output_gate_s|)) Bool (and (or  (|output_gate#317| state) false) (or  (|output_gate#319| state) false))) ; $logic_and$output_gate_properties.vh:129$347_Y
(define-fun |output_gate_a 39| ((state |output_gate_s|)) Bool (or (|output_gate#320| state) (not (= ((_ extract 0 0) (|output_gate#154| state)) #b1)))) ; settling_is_counted
(define-fun |output_gate#321| ((state |output_gate_s|)) (_ BitVec 33) (bvadd (concat #b0 (|output_gate#163| state)) (concat #b0 (|output_gate#175| state)))) ; $add$output_gate_properties.vh:126$327_Y
(define-fun |output_gate#322| ((state |output_gate_s|)) Bool (= (|output_gate#321| state) (|output_gate#195| state))) ; $eq$output_gate_properties.vh:126$329_Y
(define-fun |output_gate#323| ((state |output_gate_s|)) Bool (= (|output_gate#163| state) (|output_gate#93| state))) ; $eq$output_gate_properties.vh:126$326_Y
(define-fun |output_gate#324| ((state |output_gate_s|)) Bool (= (|output_gate#175| state) #b00000000000000000000000000000001)) ; $eq$output_gate_properties.vh:126$325_Y
(define-fun |output_gate#325| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#324| state) (ite (|output_gate#323| state) #b1 #b0) (ite (|output_gate#322| state) #b1 #b0))) ; $ternary$output_gate_properties.vh:126$330_Y
(define-fun |output_gate_a 40| ((state |output_gate_s|)) Bool (or (= ((_ extract 0 0) (|output_gate#325| state)) #b1) (not (= ((_ extract 0 0) (|output_gate#158| state)) #b1)))) ; silence_is_counted
(define-fun |output_gate_a 41| ((state |output_gate_s|)) Bool (or (= ((_ extract 1 1) (|output_gate#89| state)) #b1) (not (= ((_ extract 0 0) (|output_gate#162| state)) #b1)))) ; silence_is_kept
(define-fun |output_gate#326| ((state |output_gate_s|)) Bool (bvule (|output_gate#175| state) (|output_gate#93| state))) ; $le$output_gate_properties.vh:127$332_Y
(define-fun |output_gate#327| ((state |output_gate_s|)) Bool (or  (|output_gate#326| state) false  (|output_gate#324| state) false)) ; $logic_or$output_gate_properties.vh:127$334_Y
(define-fun |output_gate_a 42| ((state |output_gate_s|)) Bool (or (|output_gate#327| state) (not (= ((_ extract 0 0) (|output_gate#158| state)) #b1)))) ; silent_in_time
(define-fun |output_gate_a 43| ((state |output_gate_s|)) Bool (or (|output_gate#270| state) (not (= ((_ extract 0 0) (|output_gate#164| state)) #b1)))) ; silent_is_off
(define-fun |output_gate_a 44| ((state |output_gate_s|)) Bool (or (= ((_ extract 0 0) (|output_gate#89| state)) #b1) (not (= ((_ extract 0 0) (|output_gate#167| state)) #b1)))) ; stop_is_kept
(define-fun |output_gate_a 45| ((state |output_gate_s|)) Bool (or (|output_gate#270| state) (not (= ((_ extract 0 0) (|output_gate#168| state)) #b1)))) ; stopped_is_off
(define-fun |output_gate#328| ((state |output_gate_s|)) Bool (bvuge (|output_gate#176| state) #b01111010000100100)) ; $ge$output_gate_properties.vh:115$284_Y
(define-fun |output_gate#329| ((state |output_gate_s|)) Bool (or  (|output_gate#285| state) false  (|output_gate#328| state) false)) ; $logic_or$output_gate_properties.vh:115$285_Y
(define-fun |output_gate_a 46| ((state |output_gate_s|)) Bool (or (|output_gate#329| state) (not (= ((_ extract 0 0) (|output_gate#109| state)) #b1)))) ; supply_has_settled
(define-fun |output_gate_a 47| ((state |output_gate_s|)) Bool (or (= ((_ extract 3 3) (|output_gate#89| state)) #b1) (not (= ((_ extract 0 0) (|output_gate#172| state)) #b1)))) ; underrun_is_kept
(define-fun |output_gate_a 48| ((state |output_gate_s|)) Bool (or (|output_gate#270| state) (not (= ((_ extract 0 0) (|output_gate#173| state)) #b1)))) ; underrun_is_off
(define-fun |output_gate#330| ((state |output_gate_s|)) (_ BitVec 17) (bvadd (|output_gate#176| state) #b00000000000000001)) ; $add$output_gate_properties.vh:14$144_Y
(define-fun |output_gate#331| ((state |output_gate_s|)) Bool (= (|output_gate#176| state) #b01111010000100100)) ; $eq$output_gate_properties.vh:14$143_Y
(define-fun |output_gate#332| ((state |output_gate_s|)) (_ BitVec 17) (ite (|output_gate#331| state) #b01111010000100100 (|output_gate#330| state))) ; $0\longer$func$output_gate_properties.vh:57$2.$result[16:0]$115
(define-fun |output_gate#333| ((state |output_gate_s|)) Bool (or  (|output_gate#149| state) false  (|output_gate#287| state) false)) ; $logic_or$output_gate_properties.vh:57$147_Y
(define-fun |output_gate#334| ((state |output_gate_s|)) (_ BitVec 17) (ite (|output_gate#333| state) #b00000000000000000 (|output_gate#332| state))) ; $0\up_q[16:0]
(define-fun |output_gate#335| ((state |output_gate_s|)) (_ BitVec 32) (bvadd (|output_gate#175| state) #b00000000000000000000000000000001)) ; $add$output_gate_properties.vh:71$172_Y
(define-fun |output_gate#336| ((state |output_gate_s|)) Bool (= (|output_gate#175| state) #b11111111111111111111111111111111)) ; $eq$output_gate_properties.vh:71$171_Y
(define-fun |output_gate#337| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#336| state) (|output_gate#175| state) (|output_gate#335| state))) ; $ternary$output_gate_properties.vh:71$173_Y
(define-fun |output_gate#338| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#95| state) #b00000000000000000000000000000001 (|output_gate#337| state))) ; $0\unfed_q[31:0]
(define-fun |output_gate#339| ((state |output_gate_s|)) (_ BitVec 32) (bvadd (|output_gate#174| state) #b00000000000000000000000000000001)) ; $add$output_gate.v:117$49_Y
(define-fun |output_gate#340| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#51| state) (|output_gate#339| state) (|output_gate#174| state))) ; $procmux$442_Y
(define-fun |output_gate#341| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#149| state) #b00000000000000000000000000000000 (|output_gate#340| state))) ; $0\underruns_q[31:0]
(define-fun |output_gate#342| ((state |output_gate_s|)) (_ BitVec 32) (bvsub (|output_gate#163| state) #b00000000000000000000000000000001)) ; $sub$output_gate.v:101$38_Y
(define-fun |output_gate#343| ((state |output_gate_s|)) (_ BitVec 32) (ite (= ((_ extract 0 0) (|output_gate#17| state)) #b1) (|output_gate#163| state) (|output_gate#342| state))) ; $procmux$471_Y
(define-fun |output_gate#344| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#95| state) (|output_gate#96| state) (|output_gate#343| state))) ; $procmux$474_Y
(define-fun |output_gate#345| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#149| state) #b00000000000000000000000000000000 (|output_gate#344| state))) ; $0\silence_q[31:0]
(define-fun |output_gate#346| ((state |output_gate_s|)) (_ BitVec 16) (bvsub (|output_gate#150| state) #b0000000000000001)) ; $sub$output_gate.v:130$51_Y
(define-fun |output_gate#347| ((state |output_gate_s|)) (_ BitVec 16) (ite (|output_gate#76| state) (|output_gate#346| state) #b1111010000100011)) ; $ternary$output_gate.v:130$52_Y
(define-fun |output_gate#348| ((state |output_gate_s|)) (_ BitVec 16) (ite (|output_gate#149| state) #b0000000000000000 (|output_gate#347| state))) ; $0\settle_left_q[15:0]
(define-fun |output_gate#349| ((state |output_gate_s|)) (_ BitVec 32) (bvsub (|output_gate#148| state) #b00000000000000000000000000000001)) ; $sub$output_gate.v:110$45_Y
(define-fun |output_gate#350| ((state |output_gate_s|)) (_ BitVec 32) (ite (= ((_ extract 0 0) (|output_gate#140| state)) #b1) (|output_gate#349| state) (|output_gate#148| state))) ; $procmux$457_Y
(define-fun |output_gate#351| ((state |output_gate_s|)) Bool (distinct (|output_gate#53| state) #b00000)) ; $ne$output_gate.v:106$44_Y
(define-fun |output_gate#352| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#351| state) #b00000000111011100110101100101000 (|output_gate#350| state))) ; $procmux$460_Y
(define-fun |output_gate#353| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#149| state) #b00000000000000000000000000000000 (|output_gate#352| state))) ; $0\rest_left_q[31:0]
(define-fun |output_gate#354| ((state |output_gate_s|)) Bool (distinct (|output_gate#148| state) #b00000000000000000000000000000001)) ; $ne$output_gate.v:111$46_Y
(define-fun |output_gate#355| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#140| state)) #b1) (ite (|output_gate#354| state) #b1 #b0) #b0)) ; $procmux$450_Y
(define-fun |output_gate#356| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#351| state) #b1 (|output_gate#355| state))) ; $procmux$453_Y
(define-fun |output_gate#357| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#149| state) #b0 (|output_gate#356| state))) ; $0\resting_q[0:0]
(define-fun |output_gate#358| ((state |output_gate_s|)) (_ BitVec 3) (bvand (concat ((_ extract 1 0) (|output_gate#119| state)) (ite (|output_gate#83| state) #b1 #b0)) (concat (ite (|output_gate#134| state) #b1 #b0) (concat (ite (|output_gate#134| state) #b1 #b0) (ite (|output_gate#134| state) #b1 #b0))))) ; $and$output_gate.v:131$53_Y
(define-fun |output_gate#359| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#149| state) #b000 (|output_gate#358| state))) ; $0\on_later_q[2:0]
(define-fun |output_gate#360| ((state |output_gate_s|)) (_ BitVec 3) (bvand (concat ((_ extract 1 0) (|output_gate#110| state)) (ite (|output_gate#82| state) #b1 #b0)) (concat (ite (|output_gate#134| state) #b1 #b0) (concat (ite (|output_gate#134| state) #b1 #b0) (ite (|output_gate#134| state) #b1 #b0))))) ; $and$output_gate.v:132$54_Y
(define-fun |output_gate#361| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#149| state) #b000 (|output_gate#360| state))) ; $0\moves_later_q[2:0]
(define-fun |output_gate#362| ((state |output_gate_s|)) (_ BitVec 16) (bvsub (|output_gate#94| state) #b0000000000000001)) ; $sub$output_gate.v:138$66_Y
(define-fun |output_gate#363| ((state |output_gate_s|)) Bool (distinct (|output_gate#94| state) #b0000000000000000)) ; $ne$output_gate.v:138$65_Y
(define-fun |output_gate#364| ((state |output_gate_s|)) (_ BitVec 16) (ite (|output_gate#363| state) (|output_gate#362| state) (|output_gate#94| state))) ; $procmux$428_Y
(define-fun |output_gate#365| ((state |output_gate_s|)) (_ BitVec 16) (bvsub (|output_gate#41| state) #b0000000000000001)) ; $sub$output_gate.v:137$64_Y
(define-fun |output_gate#366| ((state |output_gate_s|)) (_ BitVec 16) (ite (|output_gate#75| state) (|output_gate#365| state) (|output_gate#364| state))) ; $procmux$431_Y
(define-fun |output_gate#367| ((state |output_gate_s|)) (_ BitVec 16) (ite (|output_gate#135| state) (|output_gate#366| state) #b0000000000000000)) ; $procmux$434_Y
(define-fun |output_gate#368| ((state |output_gate_s|)) (_ BitVec 16) (ite (|output_gate#149| state) #b0000000000000000 (|output_gate#367| state))) ; $0\focus_left_q[15:0]
(define-fun |output_gate#369| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#95| state) (|output_gate#96| state) (|output_gate#93| state))) ; $0\fed_ticks_q[31:0]
(define-fun |output_gate#370| ((state |output_gate_s|)) Bool (not (or  (|output_gate#149| state) false))) ; $logic_not$output_gate.v:171$72_Y
(define-fun |output_gate#371| ((state |output_gate_s|)) Bool (or  (= ((_ extract 0 0) (|output_gate#92| state)) #b1) false  (|output_gate#95| state) false)) ; $logic_or$output_gate_properties.vh:69$168_Y
(define-fun |output_gate#372| ((state |output_gate_s|)) Bool (and (or  (|output_gate#370| state) false) (or  (|output_gate#371| state) false))) ; $0\fed_q[0:0]
(define-fun |output_gate#373| ((state |output_gate_s|)) (_ BitVec 64) (ite (|output_gate#155| state) (|output_gate#118| state) (|output_gate#90| state))) ; $procmux$438_Y
(define-fun |output_gate#374| ((state |output_gate_s|)) (_ BitVec 64) (ite (|output_gate#149| state) #b0000000000000000000000000000000000000000000000000000000000000000 (|output_gate#373| state))) ; $0\fault_time_q[63:0]
(define-fun |output_gate#375| ((state |output_gate_s|)) (_ BitVec 9) (bvand (concat ((_ extract 8 4) (|output_gate#89| state)) #b0000) (concat (|output_gate#140| state) (concat (|output_gate#140| state) (concat (|output_gate#140| state) (concat (|output_gate#140| state) (concat (|output_gate#140| state) (concat (|output_gate#140| state) (concat (|output_gate#140| state) (concat (|output_gate#140| state) (|output_gate#140| state))))))))))) ; $and$output_gate.v:105$41_Y
(define-fun |output_gate#376| ((state |output_gate_s|)) (_ BitVec 9) (ite (|output_gate#56| state) (|output_gate#375| state) (|output_gate#89| state))) ; $ternary$output_gate.v:105$42_Y
(define-fun |output_gate#377| ((state |output_gate_s|)) (_ BitVec 9) (bvor (|output_gate#376| state) (concat (|output_gate#53| state) (concat (ite (|output_gate#51| state) #b1 #b0) (concat (ite (|output_gate#49| state) #b1 #b0) (concat (ite (|output_gate#46| state) #b1 #b0) (ite (|output_gate#45| state) #b1 #b0))))))) ; $or$output_gate.v:105$43_Y
(define-fun |output_gate#378| ((state |output_gate_s|)) (_ BitVec 9) (ite (|output_gate#149| state) #b000000000 (|output_gate#377| state))) ; $0\fault_q[8:0]
(define-fun |output_gate#379| ((state |output_gate_s|)) (_ BitVec 32) (bvadd (|output_gate#88| state) #b00000000000000000000000000000001)) ; $add$output_gate.v:114$47_Y
(define-fun |output_gate#380| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#155| state) (|output_gate#379| state) (|output_gate#88| state))) ; $procmux$446_Y
(define-fun |output_gate#381| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#149| state) #b00000000000000000000000000000000 (|output_gate#380| state))) ; $0\fault_count_q[31:0]
(define-fun |output_gate#382| ((state |output_gate_s|)) Bool (bvule (|output_gate#35| state) #b101)) ; $0\exists_1_q[0:0]
(define-fun |output_gate#383| ((state |output_gate_s|)) (_ BitVec 32) (bvadd (|output_gate#74| state) #b00000000000000000000000000000001)) ; $add$output_gate.v:135$62_Y
(define-fun |output_gate#384| ((state |output_gate_s|)) Bool (and (or  (|output_gate#75| state) false) (or  (|output_gate#135| state) false))) ; $logic_and$output_gate.v:135$61_Y
(define-fun |output_gate#385| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#384| state) (|output_gate#383| state) (|output_gate#74| state))) ; $procmux$424_Y
(define-fun |output_gate#386| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#149| state) #b00000000000000000000000000000000 (|output_gate#385| state))) ; $0\emissions_q[31:0]
(define-fun |output_gate#387| ((state |output_gate_s|)) Bool (not (or  (|output_gate#34| state) false))) ; $logic_not$output_gate_properties.vh:68$161_Y
(define-fun |output_gate#388| ((state |output_gate_s|)) Bool (and (or  (|output_gate#370| state) false) (or  (|output_gate#387| state) false))) ; $logic_and$output_gate_properties.vh:68$162_Y
(define-fun |output_gate#389| ((state |output_gate_s|)) Bool (not (or  (|output_gate#84| state) false))) ; $logic_not$output_gate_properties.vh:68$163_Y
(define-fun |output_gate#390| ((state |output_gate_s|)) Bool (and (or  (|output_gate#60| state) false) (or  (|output_gate#389| state) false))) ; $logic_and$output_gate_properties.vh:68$164_Y
(define-fun |output_gate#391| ((state |output_gate_s|)) Bool (or  (= ((_ extract 0 0) (|output_gate#66| state)) #b1) false  (|output_gate#390| state) false)) ; $logic_or$output_gate_properties.vh:68$165_Y
(define-fun |output_gate#392| ((state |output_gate_s|)) Bool (and (or  (|output_gate#388| state) false) (or  (|output_gate#391| state) false))) ; $0\disarmed_q[0:0]
(define-fun |output_gate#393| ((state |output_gate_s|)) Bool (not (or  (|output_gate#155| state) false))) ; $logic_not$output_gate.v:133$55_Y
(define-fun |output_gate#394| ((state |output_gate_s|)) Bool (and (or  (|output_gate#34| state) false) (or  (|output_gate#393| state) false))) ; $logic_and$output_gate.v:133$56_Y
(define-fun |output_gate#395| ((state |output_gate_s|)) Bool (and (or  (|output_gate#134| state) false) (or  (|output_gate#278| state) false))) ; $logic_and$output_gate.v:133$59_Y
(define-fun |output_gate#396| ((state |output_gate_s|)) Bool (or  (|output_gate#394| state) false  (|output_gate#395| state) false)) ; $logic_or$output_gate.v:133$60_Y
(define-fun |output_gate#397| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#149| state) #b0 (ite (|output_gate#396| state) #b1 #b0))) ; $0\live_q[0:0]
(define-fun |output_gate#398| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#137| state) #b000 (|output_gate#35| state))) ; $procmux$479_Y
(define-fun |output_gate#399| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#151| state) #b100 (|output_gate#35| state))) ; $procmux$483_Y
(define-fun |output_gate#400| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#60| state) #b011 (|output_gate#35| state))) ; $procmux$486_Y
(define-fun |output_gate#401| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#137| state) #b010 (|output_gate#35| state))) ; $procmux$489_Y
(define-fun |output_gate#402| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#60| state) #b100 (|output_gate#401| state))) ; $procmux$492_Y
(define-fun |output_gate#403| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#150| state)) #b1) (= ((_ extract 1 1) (|output_gate#150| state)) #b1) (= ((_ extract 2 2) (|output_gate#150| state)) #b1) (= ((_ extract 3 3) (|output_gate#150| state)) #b1) (= ((_ extract 4 4) (|output_gate#150| state)) #b1) (= ((_ extract 5 5) (|output_gate#150| state)) #b1) (= ((_ extract 6 6) (|output_gate#150| state)) #b1) (= ((_ extract 7 7) (|output_gate#150| state)) #b1) (= ((_ extract 8 8) (|output_gate#150| state)) #b1) (= ((_ extract 9 9) (|output_gate#150| state)) #b1) (= ((_ extract 10 10) (|output_gate#150| state)) #b1) (= ((_ extract 11 11) (|output_gate#150| state)) #b1) (= ((_ extract 12 12) (|output_gate#150| state)) #b1) (= ((_ extract 13 13) (|output_gate#150| state)) #b1) (= ((_ extract 14 14) (|output_gate#150| state)) #b1) (= ((_ extract 15 15) (|output_gate#150| state)) #b1)))) ; $eq$output_gate.v:121$50_Y
(define-fun |output_gate#404| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#403| state) #b001 (|output_gate#35| state))) ; $procmux$495_Y
(define-fun |output_gate#405| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#60| state) #b000 (|output_gate#404| state))) ; $procmux$498_Y
(define-fun |output_gate#406| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#34| state) #b101 (|output_gate#35| state))) ; $procmux$501_Y
(define-fun |output_gate#407| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#84| state) (|output_gate#406| state) (ite (|output_gate#76| state) (|output_gate#405| state) (ite (|output_gate#77| state) (|output_gate#402| state) (ite (|output_gate#36| state) (|output_gate#400| state) (ite (|output_gate#79| state) (|output_gate#399| state) (ite (|output_gate#81| state) (|output_gate#398| state) #b000))))))) ; $procmux$481_Y
(define-fun |output_gate#408| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#155| state) #b000 (|output_gate#407| state))) ; $procmux$504_Y
(define-fun |output_gate#409| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#149| state) #b000 (|output_gate#408| state))) ; $0\state_q[2:0]
(define-fun |output_gate#410| ((state |output_gate_s|)) Bool (and (or  (|output_gate#135| state) false) (or  (|output_gate#370| state) false))) ; $0\hv_enable_q[0:0]
(define-fun |output_gate#411| ((state |output_gate_s|)) Bool (or  (|output_gate#75| state) false  (|output_gate#363| state) false)) ; $logic_or$output_gate.v:174$86_Y
(define-fun |output_gate#412| ((state |output_gate_s|)) Bool (and (or  (|output_gate#410| state) false) (or  (|output_gate#411| state) false))) ; $0\focus_q[0:0]
(define-fun |output_gate#413| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#21| state)) #b1) #b0 (ite (|output_gate#412| state) #b1 #b0))) ; $auto$rtlil.cc:3381:Mux$1300
(define-fun |output_gate#414| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#16| state)) #b1) (= ((_ extract 1 1) (|output_gate#16| state)) #b1) (= ((_ extract 2 2) (|output_gate#16| state)) #b1) (= ((_ extract 3 3) (|output_gate#16| state)) #b1) (= ((_ extract 4 4) (|output_gate#16| state)) #b1) (= ((_ extract 5 5) (|output_gate#16| state)) #b1) (= ((_ extract 6 6) (|output_gate#16| state)) #b1) (= ((_ extract 7 7) (|output_gate#16| state)) #b1) (= ((_ extract 8 8) (|output_gate#16| state)) #b1) (= ((_ extract 9 9) (|output_gate#16| state)) #b1) (= ((_ extract 10 10) (|output_gate#16| state)) #b1)))) ; $eq$output_gate.v:140$68_Y
(define-fun |output_gate#415| ((state |output_gate_s|)) (_ BitVec 1) (bvxor (|output_gate#28| state) (ite (|output_gate#414| state) #b1 #b0))) ; $xor$output_gate.v:173$81_Y
(define-fun |output_gate#416| ((state |output_gate_s|)) Bool (and (or  (|output_gate#410| state) false) (or  (= ((_ extract 0 0) (|output_gate#415| state)) #b1) false))) ; $0\hv_alive_q[0:0]
(define-fun |output_gate#417| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#21| state)) #b1) #b0 (ite (|output_gate#416| state) #b1 #b0))) ; $auto$rtlil.cc:3381:Mux$1298
(define-fun |output_gate#418| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#21| state)) #b1) #b0 (ite (|output_gate#410| state) #b1 #b0))) ; $auto$rtlil.cc:3381:Mux$1302
(define-fun |output_gate#419| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 0 0) (|output_gate#20| state)) #b1) false) (or  (|output_gate#43| state) false))) ; $logic_and$output_gate_properties.vh:67$151_Y
(define-fun |output_gate#420| ((state |output_gate_s|)) Bool (and (or  (|output_gate#419| state) false) (or  (|output_gate#47| state) false))) ; $logic_and$output_gate_properties.vh:67$152_Y
(define-fun |output_gate#421| ((state |output_gate_s|)) Bool (and (or  (|output_gate#420| state) false) (or  (|output_gate#18| state) false))) ; $logic_and$output_gate_properties.vh:67$153_Y
(define-fun |output_gate#422| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#52| state)) #b1) (= ((_ extract 1 1) (|output_gate#52| state)) #b1) (= ((_ extract 2 2) (|output_gate#52| state)) #b1) (= ((_ extract 3 3) (|output_gate#52| state)) #b1) (= ((_ extract 4 4) (|output_gate#52| state)) #b1)))) ; $eq$output_gate_properties.vh:67$154_Y
(define-fun |output_gate#423| ((state |output_gate_s|)) Bool (and (or  (|output_gate#421| state) false) (or  (|output_gate#422| state) false))) ; $logic_and$output_gate_properties.vh:67$155_Y
(define-fun |output_gate#424| ((state |output_gate_s|)) Bool (not (or  (|output_gate#50| state) false))) ; $logic_not$output_gate_properties.vh:67$156_Y
(define-fun |output_gate#425| ((state |output_gate_s|)) Bool (and (or  (|output_gate#423| state) false) (or  (|output_gate#424| state) false))) ; $logic_and$output_gate_properties.vh:67$157_Y
(define-fun |output_gate#426| ((state |output_gate_s|)) Bool (or  (|output_gate#34| state) false  (|output_gate#425| state) false)) ; $logic_or$output_gate_properties.vh:67$158_Y
(define-fun |output_gate#427| ((state |output_gate_s|)) Bool (and (or  (|output_gate#370| state) false) (or  (|output_gate#426| state) false))) ; $0\allowed_q[0:0]
(define-fun |output_gate#428| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 1 1) (|output_gate#163| state)) #b1) (= ((_ extract 2 2) (|output_gate#163| state)) #b1) (= ((_ extract 3 3) (|output_gate#163| state)) #b1) (= ((_ extract 4 4) (|output_gate#163| state)) #b1) (= ((_ extract 5 5) (|output_gate#163| state)) #b1) (= ((_ extract 6 6) (|output_gate#163| state)) #b1) (= ((_ extract 7 7) (|output_gate#163| state)) #b1) (= ((_ extract 8 8) (|output_gate#163| state)) #b1) (= ((_ extract 9 9) (|output_gate#163| state)) #b1) (= ((_ extract 10 10) (|output_gate#163| state)) #b1) (= ((_ extract 11 11) (|output_gate#163| state)) #b1) (= ((_ extract 12 12) (|output_gate#163| state)) #b1) (= ((_ extract 13 13) (|output_gate#163| state)) #b1) (= ((_ extract 14 14) (|output_gate#163| state)) #b1) (= ((_ extract 15 15) (|output_gate#163| state)) #b1) (= ((_ extract 16 16) (|output_gate#163| state)) #b1) (= ((_ extract 17 17) (|output_gate#163| state)) #b1) (= ((_ extract 18 18) (|output_gate#163| state)) #b1) (= ((_ extract 19 19) (|output_gate#163| state)) #b1) (= ((_ extract 20 20) (|output_gate#163| state)) #b1) (= ((_ extract 21 21) (|output_gate#163| state)) #b1) (= ((_ extract 22 22) (|output_gate#163| state)) #b1) (= ((_ extract 23 23) (|output_gate#163| state)) #b1) (= ((_ extract 24 24) (|output_gate#163| state)) #b1) (= ((_ extract 25 25) (|output_gate#163| state)) #b1) (= ((_ extract 26 26) (|output_gate#163| state)) #b1) (= ((_ extract 27 27) (|output_gate#163| state)) #b1) (= ((_ extract 28 28) (|output_gate#163| state)) #b1) (= ((_ extract 29 29) (|output_gate#163| state)) #b1) (= ((_ extract 30 30) (|output_gate#163| state)) #b1) (= ((_ extract 31 31) (|output_gate#163| state)) #b1)))) ; $eq$output_gate.v:102$39_Y
(define-fun |output_gate#429| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#17| state)) #b1) #b1 (ite (|output_gate#428| state) #b1 #b0))) ; $procmux$464_Y
(define-fun |output_gate#430| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#95| state) #b0 (|output_gate#429| state))) ; $procmux$467_Y
(define-fun |output_gate#431| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#149| state) #b1 (|output_gate#430| state))) ; $0\silent_q[0:0]
(define-fun |output_gate#432| ((state |output_gate_s|)) (_ BitVec 11) (bvsub (|output_gate#16| state) #b00000000001)) ; $sub$output_gate.v:141$69_Y
(define-fun |output_gate#433| ((state |output_gate_s|)) (_ BitVec 11) (ite (|output_gate#414| state) #b11111001111 (|output_gate#432| state))) ; $procmux$407_Y
(define-fun |output_gate#434| ((state |output_gate_s|)) (_ BitVec 11) (ite (|output_gate#135| state) (|output_gate#433| state) #b00000000000)) ; $procmux$410_Y
(define-fun |output_gate#435| ((state |output_gate_s|)) (_ BitVec 11) (ite (|output_gate#149| state) #b00000000000 (|output_gate#434| state))) ; $0\alive_left_q[10:0]
(define-fun |output_gate#436| ((state |output_gate_s|)) (_ BitVec 17) (bvadd (|output_gate#15| state) #b00000000000000001)) ; $add$output_gate_properties.vh:14$119_Y
(define-fun |output_gate#437| ((state |output_gate_s|)) (_ BitVec 17) (ite (|output_gate#284| state) #b01111010000100100 (|output_gate#436| state))) ; $0\longer$func$output_gate_properties.vh:52$1.$result[16:0]$113
(define-fun |output_gate#438| ((state |output_gate_s|)) Bool (not (or  (|output_gate#134| state) false))) ; $logic_not$output_gate_properties.vh:52$121_Y
(define-fun |output_gate#439| ((state |output_gate_s|)) Bool (or  (|output_gate#149| state) false  (|output_gate#438| state) false)) ; $logic_or$output_gate_properties.vh:52$122_Y
(define-fun |output_gate#440| ((state |output_gate_s|)) Bool (not (or  (|output_gate#83| state) false))) ; $logic_not$output_gate_properties.vh:52$123_Y
(define-fun |output_gate#441| ((state |output_gate_s|)) Bool (or  (|output_gate#439| state) false  (|output_gate#440| state) false)) ; $logic_or$output_gate_properties.vh:52$124_Y
(define-fun |output_gate#442| ((state |output_gate_s|)) (_ BitVec 17) (ite (|output_gate#441| state) #b00000000000000000 (|output_gate#437| state))) ; $0\age_q[16:0]
(define-fun |output_gate#443| ((state |output_gate_s|)) (_ BitVec 17) (ite (|output_gate#439| state) #b00000000000000000 (|output_gate#13| state))) ; $0\age_4_q[16:0]
(define-fun |output_gate#444| ((state |output_gate_s|)) (_ BitVec 17) (ite (|output_gate#439| state) #b00000000000000000 (|output_gate#12| state))) ; $0\age_3_q[16:0]
(define-fun |output_gate#445| ((state |output_gate_s|)) (_ BitVec 17) (ite (|output_gate#439| state) #b00000000000000000 (|output_gate#11| state))) ; $0\age_2_q[16:0]
(define-fun |output_gate#446| ((state |output_gate_s|)) (_ BitVec 17) (ite (|output_gate#439| state) #b00000000000000000 (|output_gate#15| state))) ; $0\age_1_q[16:0]
(define-fun |output_gate#447| ((state |output_gate_s|)) (_ BitVec 32) (bvadd (|output_gate#7| state) #b00000000000000000000000000000001)) ; $add$output_gate_properties.vh:72$178_Y
(define-fun |output_gate#448| ((state |output_gate_s|)) Bool (= (|output_gate#7| state) #b00000000111011100110101100101000)) ; $eq$output_gate_properties.vh:72$177_Y
(define-fun |output_gate#449| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#448| state) #b00000000111011100110101100101000 (|output_gate#447| state))) ; $ternary$output_gate_properties.vh:72$179_Y
(define-fun |output_gate#450| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 0 0) (|output_gate#42| state)) #b1) false) (or  (|output_gate#131| state) false))) ; $logic_and$output_gate_properties.vh:72$176_Y
(define-fun |output_gate#451| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#450| state) #b00000000000000000000000000000000 (|output_gate#449| state))) ; $ternary$output_gate_properties.vh:72$180_Y
(define-fun |output_gate#452| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#149| state) #b00000000111011100110101100101000 (|output_gate#451| state))) ; $0\since_limit_q[31:0]
(define-fun |output_gate#453| ((state |output_gate_s|)) (_ BitVec 32) (bvand (|output_gate#70| state) (|output_gate#54| state))) ; $and$output_gate.v:171$74_Y
(define-fun |output_gate#454| ((state |output_gate_s|)) Bool (and (or  (|output_gate#135| state) false) (or  (= ((_ extract 2 2) (|output_gate#110| state)) #b1) false))) ; $logic_and$output_gate.v:171$71_Y
(define-fun |output_gate#455| ((state |output_gate_s|)) Bool (and (or  (|output_gate#454| state) false) (or  (|output_gate#370| state) false))) ; $logic_and$output_gate.v:171$73_Y
(define-fun |output_gate#456| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#455| state) (|output_gate#453| state) #b00000000000000000000000000000000)) ; $0\channel_q[31:0]
(define-fun |output_gate#457| ((state |output_gate_s|)) (_ BitVec 32) (ite (= ((_ extract 0 0) (|output_gate#21| state)) #b1) #b00000000000000000000000000000000 (|output_gate#456| state))) ; $auto$rtlil.cc:3381:Mux$1304
(define-fun |output_gate_a| ((state |output_gate_s|)) Bool (and
  (|output_gate_a 0| state)
  (|output_gate_a 1| state)
  (|output_gate_a 2| state)
  (|output_gate_a 3| state)
  (|output_gate_a 4| state)
  (|output_gate_a 5| state)
  (|output_gate_a 6| state)
  (|output_gate_a 7| state)
  (|output_gate_a 8| state)
  (|output_gate_a 9| state)
  (|output_gate_a 10| state)
  (|output_gate_a 11| state)
  (|output_gate_a 12| state)
  (|output_gate_a 13| state)
  (|output_gate_a 14| state)
  (|output_gate_a 15| state)
  (|output_gate_a 16| state)
  (|output_gate_a 17| state)
  (|output_gate_a 18| state)
  (|output_gate_a 19| state)
  (|output_gate_a 20| state)
  (|output_gate_a 21| state)
  (|output_gate_a 22| state)
  (|output_gate_a 23| state)
  (|output_gate_a 24| state)
  (|output_gate_a 25| state)
  (|output_gate_a 26| state)
  (|output_gate_a 27| state)
  (|output_gate_a 28| state)
  (|output_gate_a 29| state)
  (|output_gate_a 30| state)
  (|output_gate_a 31| state)
  (|output_gate_a 32| state)
  (|output_gate_a 33| state)
  (|output_gate_a 34| state)
  (|output_gate_a 35| state)
  (|output_gate_a 36| state)
  (|output_gate_a 37| state)
  (|output_gate_a 38| state)
  (|output_gate_a 39| state)
  (|output_gate_a 40| state)
  (|output_gate_a 41| state)
  (|output_gate_a 42| state)
  (|output_gate_a 43| state)
  (|output_gate_a 44| state)
  (|output_gate_a 45| state)
  (|output_gate_a 46| state)
  (|output_gate_a 47| state)
  (|output_gate_a 48| state)
))
(define-fun |output_gate_u| ((state |output_gate_s|)) Bool (and
  (|output_gate_u 0| state)
  (|output_gate_u 1| state)
  (|output_gate_u 2| state)
  (|output_gate_u 3| state)
))
(define-fun |output_gate_i| ((state |output_gate_s|)) Bool 
  (= (= ((_ extract 0 0) (|output_gate#5| state)) #b1) false) ; started_q
)
(define-fun |output_gate_h| ((state |output_gate_s|)) Bool true)
(define-fun |output_gate_t| ((state |output_gate_s|) (next_state |output_gate_s|)) Bool (and
  (= (|output_gate#334| state) (|output_gate#176| next_state)) ; $procdff$1005 \up_q
  (= (|output_gate#338| state) (|output_gate#175| next_state)) ; $procdff$1009 \unfed_q
  (= (|output_gate#341| state) (|output_gate#174| next_state)) ; $procdff$968 \underruns_q
  (= (ite (|output_gate#50| state) #b1 #b0) (|output_gate#169| next_state)) ; $procdff$1015 \underrun_1_q
  (= (|output_gate#345| state) (|output_gate#163| next_state)) ; $procdff$962 \silence_q
  (= (|output_gate#17| state) (|output_gate#159| next_state)) ; $procdff$993 \silent_1_q
  (= (|output_gate#348| state) (|output_gate#150| next_state)) ; $procdff$970 \settle_left_q
  (= (|output_gate#353| state) (|output_gate#148| next_state)) ; $procdff$965 \rest_left_q
  (= (|output_gate#140| state) (|output_gate#144| next_state)) ; $procdff$999 \resting_1_q
  (= (|output_gate#357| state) (|output_gate#140| next_state)) ; $procdff$966 \resting_q
  (= (ite (|output_gate#43| state) #b1 #b0) (|output_gate#136| next_state)) ; $procdff$991 \permit_1_q
  (= (|output_gate#359| state) (|output_gate#119| next_state)) ; $procdff$971 \on_later_q
  (= (|output_gate#118| state) (|output_gate#117| next_state)) ; $procdff$1020 \now_1_q
  (= (|output_gate#361| state) (|output_gate#110| next_state)) ; $procdff$972 \moves_later_q
  (= (|output_gate#54| state) (|output_gate#108| next_state)) ; $procdff$995 \mask_1_q
  (= (|output_gate#25| state) (|output_gate#98| next_state)) ; $procdff$998 \hv_1_q
  (= (|output_gate#368| state) (|output_gate#94| next_state)) ; $procdff$974 \focus_left_q
  (= (|output_gate#369| state) (|output_gate#93| next_state)) ; $procdff$1008 \fed_ticks_q
  (= (ite (|output_gate#372| state) #b1 #b0) (|output_gate#92| next_state)) ; $procdff$1010 \fed_q
  (= ((_ extract 8 4) (|output_gate#89| state)) (|output_gate#91| next_state)) ; $procdff$997 \faults_1_q
  (= (|output_gate#374| state) (|output_gate#90| next_state)) ; $procdff$969 \fault_time_q
  (= (|output_gate#378| state) (|output_gate#89| next_state)) ; $procdff$964 \fault_q
  (= (|output_gate#381| state) (|output_gate#88| next_state)) ; $procdff$967 \fault_count_q
  (= (|output_gate#88| state) (|output_gate#87| next_state)) ; $procdff$1019 \fault_count_1_q
  (= (ite (|output_gate#382| state) #b1 #b0) (|output_gate#86| next_state)) ; $procdff$994 \exists_1_q
  (= (|output_gate#386| state) (|output_gate#74| next_state)) ; $procdff$975 \emissions_q
  (= (|output_gate#70| state) (|output_gate#69| next_state)) ; $procdff$1018 \drive_1_q
  (= (ite (|output_gate#392| state) #b1 #b0) (|output_gate#66| next_state)) ; $procdff$1007 \disarmed_q
  (= (ite (|output_gate#60| state) #b1 #b0) (|output_gate#59| next_state)) ; $procdff$1013 \disarm_1_q
  (= (ite (|output_gate#47| state) #b1 #b0) (|output_gate#58| next_state)) ; $procdff$992 \cool_1_q
  (= (ite (|output_gate#56| state) #b1 #b0) (|output_gate#55| next_state)) ; $procdff$1014 \clear_1_q
  (= (|output_gate#397| state) (|output_gate#42| next_state)) ; $procdff$973 \live_q
  (= (|output_gate#52| state) (|output_gate#37| next_state)) ; $procdff$996 \limits_1_q
  (= (|output_gate#409| state) (|output_gate#35| next_state)) ; $procdff$961 \state_q
  (= (ite (|output_gate#34| state) #b1 #b0) (|output_gate#33| next_state)) ; $procdff$1012 \arm_1_q
  (= (|output_gate#413| state) (|output_gate#30| next_state)) ; $procdff$985 \_witness_.anyinit_procdff_985
  (= (|output_gate#417| state) (|output_gate#27| next_state)) ; $procdff$988 \_witness_.anyinit_procdff_988
  (= (|output_gate#418| state) (|output_gate#24| next_state)) ; $procdff$982 \_witness_.anyinit_procdff_982
  (= (ite (|output_gate#427| state) #b1 #b0) (|output_gate#20| next_state)) ; $procdff$1006 \allowed_q
  (= (concat #b0000000 (|output_gate#89| state)) (|output_gate#19| next_state)) ; $procdff$1017 \all_faults_1_q
  (= (|output_gate#431| state) (|output_gate#17| next_state)) ; $procdff$963 \silent_q
  (= (|output_gate#435| state) (|output_gate#16| next_state)) ; $procdff$976 \alive_left_q
  (= (|output_gate#442| state) (|output_gate#15| next_state)) ; $procdff$1000 \age_q
  (= (|output_gate#443| state) (|output_gate#14| next_state)) ; $procdff$1004 \age_4_q
  (= (|output_gate#444| state) (|output_gate#13| next_state)) ; $procdff$1003 \age_3_q
  (= (|output_gate#445| state) (|output_gate#12| next_state)) ; $procdff$1002 \age_2_q
  (= (|output_gate#446| state) (|output_gate#11| next_state)) ; $procdff$1001 \age_1_q
  (= (|output_gate#452| state) (|output_gate#7| next_state)) ; $procdff$1011 \since_limit_q
  (= #b1 (|output_gate#5| next_state)) ; $procdff$989 \started_q
  (= (ite (|output_gate#149| state) #b1 #b0) (|output_gate#3| next_state)) ; $procdff$990 \rst_1_q
  (= (ite (|output_gate#155| state) #b1 #b0) (|output_gate#1| next_state)) ; $procdff$1016 \shut_1_q
  (= (|output_gate#457| state) (|output_gate#0| next_state)) ; $procdff$979 \_witness_.anyinit_procdff_979
)) ; end of module output_gate
