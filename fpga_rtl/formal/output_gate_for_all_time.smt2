; of 22aff5bdc88aec704df43e8a09d9ade07efe850ce8a3fb81252761188075a687, by python -m tests.rtl.proofs
(declare-sort |output_gate_s| 0)
(declare-fun |output_gate_is| (|output_gate_s|) Bool)
(declare-fun |output_gate#0| (|output_gate_s|) (_ BitVec 32)) ; \_witness_.anyinit_procdff_1005
(define-fun |output_gate_n _witness_.anyinit_procdff_1005| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#0| state))
(declare-fun |output_gate#1| (|output_gate_s|) (_ BitVec 1)) ; \shut_1_q
(declare-fun |output_gate#2| (|output_gate_s|) (_ BitVec 16)) ; \all_faults_1_q
(define-fun |output_gate#3| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#2| state)) #b1) (= ((_ extract 1 1) (|output_gate#2| state)) #b1) (= ((_ extract 2 2) (|output_gate#2| state)) #b1) (= ((_ extract 3 3) (|output_gate#2| state)) #b1) (= ((_ extract 4 4) (|output_gate#2| state)) #b1) (= ((_ extract 5 5) (|output_gate#2| state)) #b1) (= ((_ extract 6 6) (|output_gate#2| state)) #b1) (= ((_ extract 7 7) (|output_gate#2| state)) #b1) (= ((_ extract 8 8) (|output_gate#2| state)) #b1) (= ((_ extract 9 9) (|output_gate#2| state)) #b1) (= ((_ extract 10 10) (|output_gate#2| state)) #b1) (= ((_ extract 11 11) (|output_gate#2| state)) #b1) (= ((_ extract 12 12) (|output_gate#2| state)) #b1) (= ((_ extract 13 13) (|output_gate#2| state)) #b1) (= ((_ extract 14 14) (|output_gate#2| state)) #b1) (= ((_ extract 15 15) (|output_gate#2| state)) #b1)))) ; $eq$output_gate_properties.vh:110$240_Y
(define-fun |output_gate#4| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 0 0) (|output_gate#1| state)) #b1) false) (or  (|output_gate#3| state) false))) ; $logic_and$output_gate_properties.vh:110$241_Y
(define-fun |output_gate#5| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#4| state) #b1 #b0)) ; $procmux$894_Y
(declare-fun |output_gate#6| (|output_gate_s|) (_ BitVec 1)) ; \rst_1_q
(define-fun |output_gate#7| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#6| state)) #b1) #b0 (|output_gate#5| state))) ; $procmux$896_Y
(declare-fun |output_gate#8| (|output_gate_s|) (_ BitVec 1)) ; \started_q
(define-fun |output_gate#9| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#7| state) #b0)) ; \a_fault_is_counted_EN
(define-fun |output_gate_n a_fault_is_counted_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#9| state)) #b1))
(declare-fun |output_gate#10| (|output_gate_s|) (_ BitVec 32)) ; \since_limit_q
(define-fun |output_gate#11| ((state |output_gate_s|)) Bool (bvult (|output_gate#10| state) #b00000000111011100110101100101000)) ; $lt$output_gate_properties.vh:121$270_Y
(define-fun |output_gate#12| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#11| state) #b1 #b0)) ; $procmux$846_Y
(define-fun |output_gate#13| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#12| state) #b0)) ; \a_limit_rests_EN
(define-fun |output_gate_n a_limit_rests_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#13| state)) #b1))
(declare-fun |output_gate#14| (|output_gate_s|) (_ BitVec 16)) ; \age_1_q
(define-fun |output_gate_n age_1_q| ((state |output_gate_s|)) (_ BitVec 16) (|output_gate#14| state))
(declare-fun |output_gate#15| (|output_gate_s|) (_ BitVec 16)) ; \age_2_q
(define-fun |output_gate_n age_2_q| ((state |output_gate_s|)) (_ BitVec 16) (|output_gate#15| state))
(declare-fun |output_gate#16| (|output_gate_s|) (_ BitVec 16)) ; \age_3_q
(define-fun |output_gate_n age_3_q| ((state |output_gate_s|)) (_ BitVec 16) (|output_gate#16| state))
(declare-fun |output_gate#17| (|output_gate_s|) (_ BitVec 16)) ; \age_4_q
(define-fun |output_gate_n age_4_q| ((state |output_gate_s|)) (_ BitVec 16) (|output_gate#17| state))
(declare-fun |output_gate#18| (|output_gate_s|) (_ BitVec 16)) ; \age_q
(define-fun |output_gate_n age_q| ((state |output_gate_s|)) (_ BitVec 16) (|output_gate#18| state))
(declare-fun |output_gate#19| (|output_gate_s|) (_ BitVec 11)) ; \alive_left_q
(define-fun |output_gate_n alive_left_q| ((state |output_gate_s|)) (_ BitVec 11) (|output_gate#19| state))
(declare-fun |output_gate#20| (|output_gate_s|) (_ BitVec 1)) ; \silent_q
(define-fun |output_gate#21| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#20| state)) #b1) false))) ; \alive_o
(define-fun |output_gate_n alive_o| ((state |output_gate_s|)) Bool (|output_gate#21| state))
(define-fun |output_gate_n all_faults_1_q| ((state |output_gate_s|)) (_ BitVec 16) (|output_gate#2| state))
(declare-fun |output_gate#22| (|output_gate_s|) (_ BitVec 1)) ; \allowed_q
(define-fun |output_gate_n allowed_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#22| state)) #b1))
(declare-fun |output_gate#23| (|output_gate_s|) (_ BitVec 1)) ; \clock_lost_i
(define-fun |output_gate#24| ((state |output_gate_s|)) (_ BitVec 32) (ite (= ((_ extract 0 0) (|output_gate#23| state)) #b1) #b00000000000000000000000000000000 (|output_gate#0| state))) ; \channel_q
(define-fun |output_gate#25| ((state |output_gate_s|)) Bool (distinct (|output_gate#24| state) #b00000000000000000000000000000000)) ; $ne$output_gate_properties.vh:146$361_Y
(declare-fun |output_gate#26| (|output_gate_s|) (_ BitVec 1)) ; \_witness_.anyinit_procdff_1008
(define-fun |output_gate#27| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#23| state)) #b1) #b0 (|output_gate#26| state))) ; \hv_enable_q
(define-fun |output_gate#28| ((state |output_gate_s|)) Bool (or  (|output_gate#25| state) false  (= ((_ extract 0 0) (|output_gate#27| state)) #b1) false)) ; $logic_or$output_gate_properties.vh:83$179_Y
(declare-fun |output_gate#29| (|output_gate_s|) (_ BitVec 1)) ; \_witness_.anyinit_procdff_1014
(define-fun |output_gate#30| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#23| state)) #b1) #b0 (|output_gate#29| state))) ; \hv_alive_q
(define-fun |output_gate#31| ((state |output_gate_s|)) Bool (or  (|output_gate#28| state) false  (= ((_ extract 0 0) (|output_gate#30| state)) #b1) false)) ; $logic_or$output_gate_properties.vh:83$180_Y
(declare-fun |output_gate#32| (|output_gate_s|) (_ BitVec 1)) ; \_witness_.anyinit_procdff_1011
(define-fun |output_gate#33| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#23| state)) #b1) #b0 (|output_gate#32| state))) ; \focus_q
(define-fun |output_gate#34| ((state |output_gate_s|)) Bool (or  (|output_gate#31| state) false  (= ((_ extract 0 0) (|output_gate#33| state)) #b1) false)) ; \any
(define-fun |output_gate_n any| ((state |output_gate_s|)) Bool (|output_gate#34| state))
(define-fun |output_gate#35| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#23| state)) #b1) #b0 #b1)) ; $procmux$787_Y
(define-fun |output_gate#36| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#35| state) #b0)) ; \any_is_known_EN
(define-fun |output_gate_n any_is_known_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#36| state)) #b1))
(declare-fun |output_gate#37| (|output_gate_s|) (_ BitVec 1)) ; \arm_1_q
(define-fun |output_gate_n arm_1_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#37| state)) #b1))
(declare-fun |output_gate#38| (|output_gate_s|) Bool) ; \arm_i
(define-fun |output_gate_n arm_i| ((state |output_gate_s|)) Bool (|output_gate#38| state))
(define-fun |output_gate#39| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#38| state) #b1 #b0)) ; \arm_is_allowed_EN
(define-fun |output_gate_n arm_is_allowed_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#39| state)) #b1))
(declare-fun |output_gate#40| (|output_gate_s|) (_ BitVec 3)) ; \state_q
(define-fun |output_gate#41| ((state |output_gate_s|)) Bool (= (|output_gate#40| state) #b010)) ; \armed_o
(define-fun |output_gate_n armed_o| ((state |output_gate_s|)) Bool (|output_gate#41| state))
(declare-fun |output_gate#42| (|output_gate_s|) (_ BitVec 5)) ; \limits_1_q
(define-fun |output_gate#43| ((state |output_gate_s|)) Bool (distinct (|output_gate#42| state) #b00000)) ; $ne$output_gate_properties.vh:91$211_Y
(define-fun |output_gate#44| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#43| state) #b1 #b0)) ; $procmux$962_Y
(define-fun |output_gate#45| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#44| state) #b0)) ; \beyond_is_off_EN
(define-fun |output_gate_n beyond_is_off_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#45| state)) #b1))
(declare-fun |output_gate#46| (|output_gate_s|) (_ BitVec 16)) ; \bit_ticks_i
(define-fun |output_gate_n bit_ticks_i| ((state |output_gate_s|)) (_ BitVec 16) (|output_gate#46| state))
(declare-fun |output_gate#47| (|output_gate_s|) Bool) ; \run_permit_i
(define-fun |output_gate#48| ((state |output_gate_s|)) Bool (not (or  (|output_gate#47| state) false))) ; \wrong [0]
(declare-fun |output_gate#49| (|output_gate_s|) Bool) ; \temperature_good_i
(define-fun |output_gate#50| ((state |output_gate_s|)) Bool (not (or  (|output_gate#49| state) false))) ; \wrong [2]
(declare-fun |output_gate#51| (|output_gate_s|) (_ BitVec 6)) ; { \limits_i \underrun_i }
(declare-fun |output_gate#52| (|output_gate_s|) (_ BitVec 1)) ; \live_q
(define-fun |output_gate#53| ((state |output_gate_s|)) (_ BitVec 9) (bvand (concat (|output_gate#51| state) (concat (ite (|output_gate#50| state) #b1 #b0) (concat (|output_gate#20| state) (ite (|output_gate#48| state) #b1 #b0)))) (concat (|output_gate#52| state) (concat (|output_gate#52| state) (concat #b11 (concat (|output_gate#52| state) (concat (|output_gate#52| state) (concat (|output_gate#52| state) (concat (|output_gate#52| state) (|output_gate#52| state)))))))))) ; \cause
(define-fun |output_gate_n cause| ((state |output_gate_s|)) (_ BitVec 9) (|output_gate#53| state))
(declare-fun |output_gate#54| (|output_gate_s|) (_ BitVec 32)) ; \channel_mask_i
(define-fun |output_gate_n channel_mask_i| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#54| state))
(define-fun |output_gate_n channel_o| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#24| state))
(define-fun |output_gate_n channel_q| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#24| state))
(declare-fun |output_gate#55| (|output_gate_s|) (_ BitVec 1)) ; \clear_1_q
(define-fun |output_gate_n clear_1_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#55| state)) #b1))
(declare-fun |output_gate#56| (|output_gate_s|) Bool) ; \clear_i
(define-fun |output_gate_n clear_i| ((state |output_gate_s|)) Bool (|output_gate#56| state))
(declare-fun |output_gate#57| (|output_gate_s|) Bool) ; \clk_i
(define-fun |output_gate_n clk_i| ((state |output_gate_s|)) Bool (|output_gate#57| state))
(define-fun |output_gate_n clock_is_lost_in_reset_EN| ((state |output_gate_s|)) Bool true)
(define-fun |output_gate_n clock_lost_i| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#23| state)) #b1))
(declare-fun |output_gate#58| (|output_gate_s|) (_ BitVec 1)) ; \cool_1_q
(define-fun |output_gate_n cool_1_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#58| state)) #b1))
(define-fun |output_gate#59| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#4| state) #b0 #b1)) ; $procmux$886_Y
(define-fun |output_gate#60| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#6| state)) #b1) #b0 (|output_gate#59| state))) ; $procmux$888_Y
(define-fun |output_gate#61| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#60| state) #b0)) ; \counted_once_EN
(define-fun |output_gate_n counted_once_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#61| state)) #b1))
(declare-fun |output_gate#62| (|output_gate_s|) (_ BitVec 1)) ; \disarm_1_q
(define-fun |output_gate_n disarm_1_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#62| state)) #b1))
(declare-fun |output_gate#63| (|output_gate_s|) Bool) ; \disarm_i
(define-fun |output_gate_n disarm_i| ((state |output_gate_s|)) Bool (|output_gate#63| state))
(define-fun |output_gate#64| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#37| state)) #b1) false))) ; $logic_not$output_gate_properties.vh:113$252_Y
(define-fun |output_gate#65| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 0 0) (|output_gate#62| state)) #b1) false) (or  (|output_gate#64| state) false))) ; $logic_and$output_gate_properties.vh:113$253_Y
(define-fun |output_gate#66| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#65| state) #b1 #b0)) ; $procmux$871_Y
(define-fun |output_gate#67| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#6| state)) #b1) #b0 (|output_gate#66| state))) ; $procmux$873_Y
(define-fun |output_gate#68| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#67| state) #b0)) ; \disarm_is_obeyed_EN
(define-fun |output_gate_n disarm_is_obeyed_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#68| state)) #b1))
(declare-fun |output_gate#69| (|output_gate_s|) (_ BitVec 1)) ; \disarmed_q
(define-fun |output_gate#70| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#69| state)) #b1) #b1 #b0)) ; $procmux$856_Y
(define-fun |output_gate#71| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#70| state) #b0)) ; \disarmed_for_good_EN
(define-fun |output_gate_n disarmed_for_good_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#71| state)) #b1))
(define-fun |output_gate_n disarmed_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#69| state)) #b1))
(declare-fun |output_gate#72| (|output_gate_s|) (_ BitVec 32)) ; \drive_1_q
(define-fun |output_gate_n drive_1_q| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#72| state))
(declare-fun |output_gate#73| (|output_gate_s|) (_ BitVec 32)) ; \drive_i
(define-fun |output_gate_n drive_i| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#73| state))
(define-fun |output_gate_n edges| ((state |output_gate_s|)) (_ BitVec 3) (concat ((_ extract 3 2) (|output_gate#51| state)) #b0))
(declare-fun |output_gate#74| (|output_gate_s|) (_ BitVec 5)) ; \edges_1_q
(define-fun |output_gate_n edges_1_q| ((state |output_gate_s|)) (_ BitVec 5) (|output_gate#74| state))
(define-fun |output_gate#75| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#6| state)) #b1) #b0 #b1)) ; $procmux$901_Y
(define-fun |output_gate#76| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#75| state) #b0)) ; \edges_are_kept_EN
(define-fun |output_gate_n edges_are_kept_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#76| state)) #b1))
(define-fun |output_gate#77| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#25| state) #b1 #b0)) ; $procmux$707_Y
(define-fun |output_gate#78| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#23| state)) #b1) #b0 (|output_gate#77| state))) ; $procmux$709_Y
(define-fun |output_gate#79| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#78| state) #b0)) ; \edges_once_settled_EN
(define-fun |output_gate_n edges_once_settled_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#79| state)) #b1))
(declare-fun |output_gate#80| (|output_gate_s|) (_ BitVec 32)) ; \emissions_q
(define-fun |output_gate_n emissions_o| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#80| state))
(define-fun |output_gate_n emissions_q| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#80| state))
(declare-fun |output_gate#81| (|output_gate_s|) Bool) ; \ended_i
(define-fun |output_gate_n ended_i| ((state |output_gate_s|)) Bool (|output_gate#81| state))
(define-fun |output_gate#82| ((state |output_gate_s|)) Bool (= (|output_gate#40| state) #b101)) ; \settling
(define-fun |output_gate#83| ((state |output_gate_s|)) Bool (= (|output_gate#40| state) #b001)) ; \ramp_up_o
(define-fun |output_gate#84| ((state |output_gate_s|)) Bool (or  (|output_gate#83| state) false  (|output_gate#41| state) false)) ; $logic_or$output_gate.v:84$10_Y
(define-fun |output_gate#85| ((state |output_gate_s|)) Bool (= (|output_gate#40| state) #b011)) ; \stopping_o
(define-fun |output_gate#86| ((state |output_gate_s|)) Bool (or  (|output_gate#84| state) false  (|output_gate#85| state) false)) ; $logic_or$output_gate.v:84$12_Y
(define-fun |output_gate#87| ((state |output_gate_s|)) Bool (= (|output_gate#40| state) #b100)) ; \ramp_down_o
(define-fun |output_gate#88| ((state |output_gate_s|)) Bool (or  (|output_gate#86| state) false  (|output_gate#87| state) false)) ; \moves
(define-fun |output_gate#89| ((state |output_gate_s|)) Bool (or  (|output_gate#82| state) false  (|output_gate#88| state) false)) ; \on
(define-fun |output_gate#90| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#40| state)) #b1) (= ((_ extract 1 1) (|output_gate#40| state)) #b1) (= ((_ extract 2 2) (|output_gate#40| state)) #b1)))) ; \off_o
(define-fun |output_gate#91| ((state |output_gate_s|)) Bool (or  (|output_gate#89| state) false  (|output_gate#90| state) false)) ; \exists
(define-fun |output_gate_n exists| ((state |output_gate_s|)) Bool (|output_gate#91| state))
(declare-fun |output_gate#92| (|output_gate_s|) (_ BitVec 1)) ; \exists_1_q
(define-fun |output_gate_n exists_1_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#92| state)) #b1))
(declare-fun |output_gate#93| (|output_gate_s|) (_ BitVec 32)) ; \fault_count_1_q
(define-fun |output_gate_n fault_count_1_q| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#93| state))
(declare-fun |output_gate#94| (|output_gate_s|) (_ BitVec 32)) ; \fault_count_q
(define-fun |output_gate_n fault_count_o| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#94| state))
(define-fun |output_gate_n fault_count_q| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#94| state))
(declare-fun |output_gate#95| (|output_gate_s|) (_ BitVec 9)) ; \fault_q
(define-fun |output_gate_n fault_o| ((state |output_gate_s|)) (_ BitVec 16) (concat #b0000000 (|output_gate#95| state)))
(define-fun |output_gate_n fault_q| ((state |output_gate_s|)) (_ BitVec 9) (|output_gate#95| state))
(declare-fun |output_gate#96| (|output_gate_s|) (_ BitVec 64)) ; \fault_time_q
(define-fun |output_gate_n fault_time_o| ((state |output_gate_s|)) (_ BitVec 64) (|output_gate#96| state))
(define-fun |output_gate_n fault_time_q| ((state |output_gate_s|)) (_ BitVec 64) (|output_gate#96| state))
(declare-fun |output_gate#97| (|output_gate_s|) (_ BitVec 1)) ; \faulted_q
(define-fun |output_gate_n faulted_o| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#97| state)) #b1))
(define-fun |output_gate_n faulted_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#97| state)) #b1))
(declare-fun |output_gate#98| (|output_gate_s|) (_ BitVec 5)) ; \faults_1_q
(define-fun |output_gate_n faults_1_q| ((state |output_gate_s|)) (_ BitVec 5) (|output_gate#98| state))
(declare-fun |output_gate#99| (|output_gate_s|) (_ BitVec 1)) ; \fed_q
(define-fun |output_gate_n fed_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#99| state)) #b1))
(declare-fun |output_gate#100| (|output_gate_s|) (_ BitVec 32)) ; \fed_ticks_q
(define-fun |output_gate_n fed_ticks_q| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#100| state))
(declare-fun |output_gate#101| (|output_gate_s|) (_ BitVec 16)) ; \focus_left_q
(define-fun |output_gate_n focus_left_q| ((state |output_gate_s|)) (_ BitVec 16) (|output_gate#101| state))
(define-fun |output_gate_n focus_o| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#33| state)) #b1))
(define-fun |output_gate_n focus_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#33| state)) #b1))
(declare-fun |output_gate#102| (|output_gate_s|) Bool) ; \heartbeat_i
(define-fun |output_gate_n heartbeat_i| ((state |output_gate_s|)) Bool (|output_gate#102| state))
(declare-fun |output_gate#103| (|output_gate_s|) (_ BitVec 32)) ; \heartbeat_ticks_i
(define-fun |output_gate_n heartbeat_ticks_i| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#103| state))
(define-fun |output_gate#104| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#58| state)) #b1) #b0 #b1)) ; $procmux$932_Y
(declare-fun |output_gate#105| (|output_gate_s|) (_ BitVec 1)) ; \hv_1_q
(define-fun |output_gate#106| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#6| state)) #b1) false))) ; $logic_not$output_gate_properties.vh:122$272_Y
(define-fun |output_gate#107| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 0 0) (|output_gate#105| state)) #b1) false) (or  (|output_gate#106| state) false))) ; $logic_and$output_gate_properties.vh:99$223_Y
(define-fun |output_gate#108| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#107| state) (|output_gate#104| state) #b0)) ; $procmux$934_Y
(define-fun |output_gate#109| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#108| state) #b0)) ; \heat_is_kept_EN
(define-fun |output_gate_n heat_is_kept_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#109| state)) #b1))
(define-fun |output_gate#110| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#104| state) #b0)) ; \hot_is_off_EN
(define-fun |output_gate_n hot_is_off_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#110| state)) #b1))
(define-fun |output_gate_n hv_1_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#105| state)) #b1))
(define-fun |output_gate_n hv_alive_o| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#30| state)) #b1))
(define-fun |output_gate_n hv_alive_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#30| state)) #b1))
(define-fun |output_gate_n hv_enable_o| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#27| state)) #b1))
(define-fun |output_gate_n hv_enable_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#27| state)) #b1))
(define-fun |output_gate_n limits_1_q| ((state |output_gate_s|)) (_ BitVec 5) (|output_gate#42| state))
(define-fun |output_gate#111| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#107| state) #b1 #b0)) ; $procmux$920_Y
(define-fun |output_gate#112| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#111| state) #b0)) ; \limits_are_kept_EN
(define-fun |output_gate_n limits_are_kept_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#112| state)) #b1))
(define-fun |output_gate_n limits_i| ((state |output_gate_s|)) (_ BitVec 5) ((_ extract 5 1) (|output_gate#51| state)))
(define-fun |output_gate_n live_is_anything_on_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#36| state)) #b1))
(define-fun |output_gate_n live_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#52| state)) #b1))
(define-fun |output_gate_n _witness_.anyinit_procdff_1008| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#26| state)) #b1))
(define-fun |output_gate_n _witness_.anyinit_procdff_1011| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#32| state)) #b1))
(define-fun |output_gate_n _witness_.anyinit_procdff_1014| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#29| state)) #b1))
(declare-fun |output_gate#113| (|output_gate_s|) (_ BitVec 32)) ; \mask_1_q
(define-fun |output_gate_n mask_1_q| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#113| state))
(define-fun |output_gate#114| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) #b1 #b0)) ; \mask_is_kept_EN
(define-fun |output_gate_n mask_is_kept_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#114| state)) #b1))
(define-fun |output_gate_n moves| ((state |output_gate_s|)) Bool (|output_gate#88| state))
(declare-fun |output_gate#115| (|output_gate_s|) (_ BitVec 3)) ; \moves_later_q
(define-fun |output_gate_n moves_later_q| ((state |output_gate_s|)) (_ BitVec 3) (|output_gate#115| state))
(define-fun |output_gate#116| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#88| state) #b1 #b0)) ; $procmux$739_Y
(define-fun |output_gate#117| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#23| state)) #b1) #b0 (|output_gate#116| state))) ; $procmux$741_Y
(define-fun |output_gate#118| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#117| state) #b0)) ; \moves_once_settled_EN
(define-fun |output_gate_n moves_once_settled_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#118| state)) #b1))
(define-fun |output_gate_n no_channel_alone_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#114| state)) #b1))
(define-fun |output_gate#119| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#23| state)) #b1) #b1 #b0)) ; \no_clock_is_off_EN
(define-fun |output_gate_n no_clock_is_off_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#119| state)) #b1))
(define-fun |output_gate_n no_sign_of_life_alone_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#114| state)) #b1))
(define-fun |output_gate#120| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#92| state)) #b1) #b0 #b1)) ; $procmux$952_Y
(define-fun |output_gate#121| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#120| state) #b0)) ; \nonsense_is_off_EN
(define-fun |output_gate_n nonsense_is_off_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#121| state)) #b1))
(declare-fun |output_gate#122| (|output_gate_s|) (_ BitVec 64)) ; \now_1_q
(define-fun |output_gate_n now_1_q| ((state |output_gate_s|)) (_ BitVec 64) (|output_gate#122| state))
(declare-fun |output_gate#123| (|output_gate_s|) (_ BitVec 64)) ; \now_i
(define-fun |output_gate_n now_i| ((state |output_gate_s|)) (_ BitVec 64) (|output_gate#123| state))
(define-fun |output_gate_n off_o| ((state |output_gate_s|)) Bool (|output_gate#90| state))
(define-fun |output_gate_n on| ((state |output_gate_s|)) Bool (|output_gate#89| state))
(declare-fun |output_gate#124| (|output_gate_s|) (_ BitVec 3)) ; \on_later_q
(define-fun |output_gate_n on_later_q| ((state |output_gate_s|)) (_ BitVec 3) (|output_gate#124| state))
(define-fun |output_gate#125| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#34| state) #b1 #b0)) ; $procmux$851_Y
(define-fun |output_gate#126| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#125| state) #b0)) ; \on_once_armed_EN
(define-fun |output_gate_n on_once_armed_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#126| state)) #b1))
(define-fun |output_gate_n on_while_fed_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#126| state)) #b1))
(define-fun |output_gate_n on_without_fault_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#126| state)) #b1))
(define-fun |output_gate#127| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#1| state)) #b1) #b0 #b1)) ; $procmux$878_Y
(define-fun |output_gate#128| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#6| state)) #b1) #b0 (|output_gate#127| state))) ; $procmux$880_Y
(define-fun |output_gate#129| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#128| state) #b0)) ; \only_a_cause_is_kept_EN
(define-fun |output_gate_n only_a_cause_is_kept_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#129| state)) #b1))
(define-fun |output_gate#130| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#55| state)) #b1) #b0 #b1)) ; $procmux$906_Y
(define-fun |output_gate#131| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#6| state)) #b1) #b0 (|output_gate#130| state))) ; $procmux$908_Y
(define-fun |output_gate#132| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#131| state) #b0)) ; \only_a_command_clears_EN
(define-fun |output_gate_n only_a_command_clears_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#132| state)) #b1))
(define-fun |output_gate_n only_what_is_played_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#114| state)) #b1))
(define-fun |output_gate#133| ((state |output_gate_s|)) Bool (not (or  (|output_gate#48| state) (= ((_ extract 0 0) (|output_gate#20| state)) #b1) (|output_gate#50| state) (= ((_ extract 0 0) (|output_gate#51| state)) #b1) (= ((_ extract 1 1) (|output_gate#51| state)) #b1) (= ((_ extract 2 2) (|output_gate#51| state)) #b1) (= ((_ extract 3 3) (|output_gate#51| state)) #b1) (= ((_ extract 4 4) (|output_gate#51| state)) #b1) (= ((_ extract 5 5) (|output_gate#51| state)) #b1)))) ; $eq$output_gate.v:95$23_Y
(define-fun |output_gate#134| ((state |output_gate_s|)) Bool (and (or  (|output_gate#91| state) false) (or  (|output_gate#133| state) false))) ; \stays
(define-fun |output_gate#135| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 2 2) (|output_gate#124| state)) #b1) false) (or  (|output_gate#134| state) false))) ; \open
(define-fun |output_gate_n open| ((state |output_gate_s|)) Bool (|output_gate#135| state))
(declare-fun |output_gate#136| (|output_gate_s|) (_ BitVec 1)) ; \permit_1_q
(define-fun |output_gate_n permit_1_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#136| state)) #b1))
(declare-fun |output_gate#137| (|output_gate_s|) Bool) ; \ramp_done_i
(define-fun |output_gate_n ramp_done_i| ((state |output_gate_s|)) Bool (|output_gate#137| state))
(define-fun |output_gate_n ramp_down_o| ((state |output_gate_s|)) Bool (|output_gate#87| state))
(define-fun |output_gate_n ramp_up_o| ((state |output_gate_s|)) Bool (|output_gate#83| state))
(define-fun |output_gate#138| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#6| state)) #b1) #b1 #b0)) ; $procmux$982_Y
(define-fun |output_gate#139| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#138| state) #b0)) ; \reset_is_off_EN
(define-fun |output_gate_n reset_is_off_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#139| state)) #b1))
(define-fun |output_gate_n rest_has_its_time_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#36| state)) #b1))
(declare-fun |output_gate#140| (|output_gate_s|) (_ BitVec 1)) ; \resting_q
(define-fun |output_gate#141| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#140| state)) #b1) #b1 #b0)) ; $procmux$807_Y
(define-fun |output_gate#142| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#23| state)) #b1) #b0 (|output_gate#141| state))) ; $procmux$809_Y
(define-fun |output_gate#143| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#142| state) #b0)) ; \rest_is_counted_EN
(define-fun |output_gate_n rest_is_counted_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#143| state)) #b1))
(declare-fun |output_gate#144| (|output_gate_s|) (_ BitVec 1)) ; \resting_1_q
(define-fun |output_gate#145| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 0 0) (|output_gate#144| state)) #b1) false) (or  (|output_gate#106| state) false))) ; $logic_and$output_gate_properties.vh:122$273_Y
(define-fun |output_gate#146| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#145| state) #b1 #b0)) ; $procmux$841_Y
(define-fun |output_gate#147| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#146| state) #b0)) ; \rest_is_kept_EN
(define-fun |output_gate_n rest_is_kept_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#147| state)) #b1))
(declare-fun |output_gate#148| (|output_gate_s|) (_ BitVec 32)) ; \rest_left_q
(define-fun |output_gate_n rest_left_q| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#148| state))
(define-fun |output_gate_n resting_1_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#144| state)) #b1))
(define-fun |output_gate_n resting_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#140| state)) #b1))
(define-fun |output_gate#149| ((state |output_gate_s|)) (_ BitVec 9) (bvand (concat ((_ extract 8 4) (|output_gate#95| state)) #b0000) (concat (|output_gate#140| state) (concat (|output_gate#140| state) (concat (|output_gate#140| state) (concat (|output_gate#140| state) (concat (|output_gate#140| state) (concat (|output_gate#140| state) (concat (|output_gate#140| state) (concat (|output_gate#140| state) (|output_gate#140| state))))))))))) ; \rests
(define-fun |output_gate_n rests| ((state |output_gate_s|)) (_ BitVec 9) (|output_gate#149| state))
(define-fun |output_gate_n rst_1_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#6| state)) #b1))
(declare-fun |output_gate#150| (|output_gate_s|) Bool) ; \rst_i
(define-fun |output_gate_n rst_i| ((state |output_gate_s|)) Bool (|output_gate#150| state))
(define-fun |output_gate_n run_permit_i| ((state |output_gate_s|)) Bool (|output_gate#47| state))
(declare-fun |output_gate#151| (|output_gate_s|) (_ BitVec 16)) ; \settle_left_q
(define-fun |output_gate_n settle_left_q| ((state |output_gate_s|)) (_ BitVec 16) (|output_gate#151| state))
(declare-fun |output_gate#152| (|output_gate_s|) Bool) ; \settled_i
(define-fun |output_gate_n settled_i| ((state |output_gate_s|)) Bool (|output_gate#152| state))
(define-fun |output_gate_n settling| ((state |output_gate_s|)) Bool (|output_gate#82| state))
(define-fun |output_gate#153| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#82| state) #b1 #b0)) ; $procmux$747_Y
(define-fun |output_gate#154| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#23| state)) #b1) #b0 (|output_gate#153| state))) ; $procmux$749_Y
(define-fun |output_gate#155| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#154| state) #b0)) ; \settling_is_counted_EN
(define-fun |output_gate_n settling_is_counted_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#155| state)) #b1))
(define-fun |output_gate_n settling_o| ((state |output_gate_s|)) Bool (|output_gate#82| state))
(define-fun |output_gate#156| ((state |output_gate_s|)) Bool (distinct (|output_gate#53| state) #b000000000)) ; \shut
(define-fun |output_gate_n shut| ((state |output_gate_s|)) Bool (|output_gate#156| state))
(define-fun |output_gate_n shut_1_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#1| state)) #b1))
(define-fun |output_gate_n shut_o| ((state |output_gate_s|)) Bool (|output_gate#156| state))
(define-fun |output_gate#157| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#20| state)) #b1) #b0 #b1)) ; $procmux$763_Y
(define-fun |output_gate#158| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#23| state)) #b1) #b0 (|output_gate#157| state))) ; $procmux$765_Y
(define-fun |output_gate#159| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#158| state) #b0)) ; \silence_is_counted_EN
(define-fun |output_gate_n silence_is_counted_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#159| state)) #b1))
(declare-fun |output_gate#160| (|output_gate_s|) (_ BitVec 1)) ; \silent_1_q
(define-fun |output_gate#161| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#160| state)) #b1) #b1 #b0)) ; $procmux$925_Y
(define-fun |output_gate#162| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#107| state) (|output_gate#161| state) #b0)) ; $procmux$927_Y
(define-fun |output_gate#163| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#162| state) #b0)) ; \silence_is_kept_EN
(define-fun |output_gate_n silence_is_kept_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#163| state)) #b1))
(declare-fun |output_gate#164| (|output_gate_s|) (_ BitVec 32)) ; \silence_q
(define-fun |output_gate_n silence_q| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#164| state))
(define-fun |output_gate_n silent_1_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#160| state)) #b1))
(define-fun |output_gate_n silent_in_time_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#159| state)) #b1))
(define-fun |output_gate#165| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#161| state) #b0)) ; \silent_is_off_EN
(define-fun |output_gate_n silent_is_off_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#165| state)) #b1))
(define-fun |output_gate_n silent_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#20| state)) #b1))
(define-fun |output_gate_n since_limit_q| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#10| state))
(define-fun |output_gate_n started_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#8| state)) #b1))
(define-fun |output_gate_n state_q| ((state |output_gate_s|)) (_ BitVec 3) (|output_gate#40| state))
(define-fun |output_gate_n stays| ((state |output_gate_s|)) Bool (|output_gate#134| state))
(define-fun |output_gate#166| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#136| state)) #b1) #b0 #b1)) ; $procmux$939_Y
(define-fun |output_gate#167| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#107| state) (|output_gate#166| state) #b0)) ; $procmux$941_Y
(define-fun |output_gate#168| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#167| state) #b0)) ; \stop_is_kept_EN
(define-fun |output_gate_n stop_is_kept_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#168| state)) #b1))
(define-fun |output_gate#169| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#166| state) #b0)) ; \stopped_is_off_EN
(define-fun |output_gate_n stopped_is_off_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#169| state)) #b1))
(define-fun |output_gate_n stopping_o| ((state |output_gate_s|)) Bool (|output_gate#85| state))
(define-fun |output_gate_n supply_has_settled_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#114| state)) #b1))
(define-fun |output_gate_n temperature_good_i| ((state |output_gate_s|)) Bool (|output_gate#49| state))
(declare-fun |output_gate#170| (|output_gate_s|) (_ BitVec 1)) ; \underrun_1_q
(define-fun |output_gate_n underrun_1_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#170| state)) #b1))
(define-fun |output_gate_n underrun_i| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#51| state)) #b1))
(define-fun |output_gate#171| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#170| state)) #b1) #b1 #b0)) ; $procmux$913_Y
(define-fun |output_gate#172| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#107| state) (|output_gate#171| state) #b0)) ; $procmux$915_Y
(define-fun |output_gate#173| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#172| state) #b0)) ; \underrun_is_kept_EN
(define-fun |output_gate_n underrun_is_kept_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#173| state)) #b1))
(define-fun |output_gate#174| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#171| state) #b0)) ; \underrun_is_off_EN
(define-fun |output_gate_n underrun_is_off_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#174| state)) #b1))
(declare-fun |output_gate#175| (|output_gate_s|) (_ BitVec 32)) ; \underruns_q
(define-fun |output_gate_n underruns_o| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#175| state))
(define-fun |output_gate_n underruns_q| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#175| state))
(declare-fun |output_gate#176| (|output_gate_s|) (_ BitVec 32)) ; \unfed_q
(define-fun |output_gate_n unfed_q| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#176| state))
(declare-fun |output_gate#177| (|output_gate_s|) (_ BitVec 16)) ; \up_q
(define-fun |output_gate_n up_q| ((state |output_gate_s|)) (_ BitVec 16) (|output_gate#177| state))
(define-fun |output_gate_n wrong| ((state |output_gate_s|)) (_ BitVec 9) (concat (|output_gate#51| state) (concat (ite (|output_gate#50| state) #b1 #b0) (concat (|output_gate#20| state) (ite (|output_gate#48| state) #b1 #b0)))))
(define-fun |output_gate#178| ((state |output_gate_s|)) (_ BitVec 1) (bvnot (ite (|output_gate#57| state) #b1 #b0))) ; $auto$rtlil.cc:3245:Not$1359
(define-fun |output_gate_u 0| ((state |output_gate_s|)) Bool (or (= ((_ extract 0 0) (|output_gate#178| state)) #b1) (not true))) ; $auto$formalff.cc:987:execute$1360
(define-fun |output_gate#179| ((state |output_gate_s|)) Bool (bvule (|output_gate#18| state) #b1111010000100100)) ; $le$output_gate_properties.vh:130$297_Y
(define-fun |output_gate#180| ((state |output_gate_s|)) Bool (bvule (|output_gate#14| state) #b1111010000100100)) ; $le$output_gate_properties.vh:130$298_Y
(define-fun |output_gate#181| ((state |output_gate_s|)) Bool (and (or  (|output_gate#179| state) false) (or  (|output_gate#180| state) false))) ; $logic_and$output_gate_properties.vh:130$299_Y
(define-fun |output_gate#182| ((state |output_gate_s|)) Bool (bvule (|output_gate#15| state) #b1111010000100100)) ; $le$output_gate_properties.vh:130$300_Y
(define-fun |output_gate#183| ((state |output_gate_s|)) Bool (and (or  (|output_gate#181| state) false) (or  (|output_gate#182| state) false))) ; $logic_and$output_gate_properties.vh:130$301_Y
(define-fun |output_gate#184| ((state |output_gate_s|)) Bool (bvule (|output_gate#16| state) #b1111010000100100)) ; $le$output_gate_properties.vh:130$302_Y
(define-fun |output_gate#185| ((state |output_gate_s|)) Bool (and (or  (|output_gate#183| state) false) (or  (|output_gate#184| state) false))) ; $logic_and$output_gate_properties.vh:130$303_Y
(define-fun |output_gate#186| ((state |output_gate_s|)) Bool (bvule (|output_gate#17| state) #b1111010000100100)) ; $le$output_gate_properties.vh:130$304_Y
(define-fun |output_gate#187| ((state |output_gate_s|)) Bool (and (or  (|output_gate#185| state) false) (or  (|output_gate#186| state) false))) ; $logic_and$output_gate_properties.vh:130$305_Y
(define-fun |output_gate_a 0| ((state |output_gate_s|)) Bool (or (|output_gate#187| state) (not (= ((_ extract 0 0) (|output_gate#36| state)) #b1)))) ; _witness_.assert_assert_output_gate_properties_vh_130_296
(define-fun |output_gate#188| ((state |output_gate_s|)) Bool (bvule (|output_gate#177| state) #b1111010000100100)) ; $le$output_gate_properties.vh:131$307_Y
(define-fun |output_gate_a 1| ((state |output_gate_s|)) Bool (or (|output_gate#188| state) (not (= ((_ extract 0 0) (|output_gate#36| state)) #b1)))) ; _witness_.assert_assert_output_gate_properties_vh_131_306
(define-fun |output_gate#189| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#95| state)) #b1) (= ((_ extract 1 1) (|output_gate#95| state)) #b1) (= ((_ extract 2 2) (|output_gate#95| state)) #b1) (= ((_ extract 3 3) (|output_gate#95| state)) #b1) (= ((_ extract 4 4) (|output_gate#95| state)) #b1) (= ((_ extract 5 5) (|output_gate#95| state)) #b1) (= ((_ extract 6 6) (|output_gate#95| state)) #b1) (= ((_ extract 7 7) (|output_gate#95| state)) #b1) (= ((_ extract 8 8) (|output_gate#95| state)) #b1)))) ; $eq$output_gate_properties.vh:135$319_Y
(define-fun |output_gate#190| ((state |output_gate_s|)) Bool (and (or  (|output_gate#189| state) false) (or  (= ((_ extract 0 0) (|output_gate#22| state)) #b1) false))) ; $logic_and$output_gate_properties.vh:135$320_Y
(define-fun |output_gate#191| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#52| state)) #b1) #b1 #b0)) ; $procmux$755_Y
(define-fun |output_gate#192| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#23| state)) #b1) #b0 (|output_gate#191| state))) ; $procmux$757_Y
(define-fun |output_gate#193| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#192| state) #b0)) ; $assert$output_gate_properties.vh:135$318_EN
(define-fun |output_gate_a 2| ((state |output_gate_s|)) Bool (or (|output_gate#190| state) (not (= ((_ extract 0 0) (|output_gate#193| state)) #b1)))) ; _witness_.assert_assert_output_gate_properties_vh_135_318
(define-fun |output_gate#194| ((state |output_gate_s|)) Bool (distinct (|output_gate#176| state) #b00000000000000000000000000000000)) ; $ne$output_gate_properties.vh:137$325_Y
(define-fun |output_gate#195| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 0 0) (|output_gate#99| state)) #b1) false) (or  (|output_gate#194| state) false))) ; $logic_and$output_gate_properties.vh:137$326_Y
(define-fun |output_gate_a 3| ((state |output_gate_s|)) Bool (or (|output_gate#195| state) (not (= ((_ extract 0 0) (|output_gate#159| state)) #b1)))) ; _witness_.assert_assert_output_gate_properties_vh_137_324
(define-fun |output_gate#196| ((state |output_gate_s|)) (_ BitVec 33) (bvadd (concat #b0 (|output_gate#100| state)) #b000000000000000000000000000000001)) ; $add$output_gate_properties.vh:119$265_Y
(define-fun |output_gate#197| ((state |output_gate_s|)) Bool (bvule (concat #b0 (|output_gate#176| state)) (|output_gate#196| state))) ; $le$output_gate_properties.vh:119$266_Y
(define-fun |output_gate#198| ((state |output_gate_s|)) Bool (bvule (|output_gate#176| state) #b00000000000000000000000000000010)) ; $le$output_gate_properties.vh:119$267_Y
(define-fun |output_gate#199| ((state |output_gate_s|)) Bool (or  (|output_gate#197| state) false  (|output_gate#198| state) false)) ; $logic_or$output_gate_properties.vh:119$268_Y
(define-fun |output_gate#200| ((state |output_gate_s|)) Bool (and (or  (|output_gate#195| state) false) (or  (|output_gate#199| state) false))) ; $logic_and$output_gate_properties.vh:140$345_Y
(define-fun |output_gate_a 4| ((state |output_gate_s|)) Bool (or (|output_gate#200| state) (not (= ((_ extract 0 0) (|output_gate#193| state)) #b1)))) ; _witness_.assert_assert_output_gate_properties_vh_140_338
(define-fun |output_gate#201| ((state |output_gate_s|)) Bool (= (|output_gate#14| state) #b1111010000100100)) ; $eq$output_gate_properties.vh:143$353_Y
(define-fun |output_gate#202| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 0 0) (|output_gate#124| state)) #b1) false) (or  (|output_gate#201| state) false))) ; $logic_and$output_gate_properties.vh:143$354_Y
(define-fun |output_gate#203| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#115| state)) #b1) #b1 #b0)) ; $procmux$731_Y
(define-fun |output_gate#204| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#23| state)) #b1) #b0 (|output_gate#203| state))) ; $procmux$733_Y
(define-fun |output_gate#205| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#204| state) #b0)) ; $assert$output_gate_properties.vh:143$352_EN
(define-fun |output_gate_a 5| ((state |output_gate_s|)) Bool (or (|output_gate#202| state) (not (= ((_ extract 0 0) (|output_gate#205| state)) #b1)))) ; _witness_.assert_assert_output_gate_properties_vh_143_352
(define-fun |output_gate#206| ((state |output_gate_s|)) Bool (= (|output_gate#15| state) #b1111010000100100)) ; $eq$output_gate_properties.vh:144$356_Y
(define-fun |output_gate#207| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 1 1) (|output_gate#124| state)) #b1) false) (or  (|output_gate#206| state) false))) ; $logic_and$output_gate_properties.vh:144$357_Y
(define-fun |output_gate#208| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 1 1) (|output_gate#115| state)) #b1) #b1 #b0)) ; $procmux$723_Y
(define-fun |output_gate#209| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#23| state)) #b1) #b0 (|output_gate#208| state))) ; $procmux$725_Y
(define-fun |output_gate#210| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#209| state) #b0)) ; $assert$output_gate_properties.vh:144$355_EN
(define-fun |output_gate_a 6| ((state |output_gate_s|)) Bool (or (|output_gate#207| state) (not (= ((_ extract 0 0) (|output_gate#210| state)) #b1)))) ; _witness_.assert_assert_output_gate_properties_vh_144_355
(define-fun |output_gate#211| ((state |output_gate_s|)) Bool (= (|output_gate#16| state) #b1111010000100100)) ; $eq$output_gate_properties.vh:145$359_Y
(define-fun |output_gate#212| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 2 2) (|output_gate#124| state)) #b1) false) (or  (|output_gate#211| state) false))) ; $logic_and$output_gate_properties.vh:145$360_Y
(define-fun |output_gate#213| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 2 2) (|output_gate#115| state)) #b1) #b1 #b0)) ; $procmux$715_Y
(define-fun |output_gate#214| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#23| state)) #b1) #b0 (|output_gate#213| state))) ; $procmux$717_Y
(define-fun |output_gate#215| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#214| state) #b0)) ; $assert$output_gate_properties.vh:145$358_EN
(define-fun |output_gate_a 7| ((state |output_gate_s|)) Bool (or (|output_gate#212| state) (not (= ((_ extract 0 0) (|output_gate#215| state)) #b1)))) ; _witness_.assert_assert_output_gate_properties_vh_145_358
(define-fun |output_gate#216| ((state |output_gate_s|)) (_ BitVec 16) (bvadd (|output_gate#14| state) #b0000000000000001)) ; $add$output_gate_properties.vh:15$369_Y
(define-fun |output_gate#217| ((state |output_gate_s|)) (_ BitVec 16) (ite (|output_gate#201| state) #b1111010000100100 (|output_gate#216| state))) ; $ternary$output_gate_properties.vh:15$370_Y
(define-fun |output_gate#218| ((state |output_gate_s|)) Bool (= (|output_gate#18| state) (|output_gate#217| state))) ; $eq$output_gate_properties.vh:147$372_Y
(define-fun |output_gate#219| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 0 0) (|output_gate#124| state)) #b1) false) (or  (|output_gate#218| state) false))) ; $logic_and$output_gate_properties.vh:147$373_Y
(define-fun |output_gate#220| ((state |output_gate_s|)) Bool (distinct (|output_gate#18| state) #b0000000000000000)) ; $ne$output_gate_properties.vh:147$364_Y
(define-fun |output_gate#221| ((state |output_gate_s|)) Bool (and (or  (|output_gate#89| state) false) (or  (|output_gate#220| state) false))) ; $logic_and$output_gate_properties.vh:147$365_Y
(define-fun |output_gate#222| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#221| state) #b1 #b0)) ; $procmux$699_Y
(define-fun |output_gate#223| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#23| state)) #b1) #b0 (|output_gate#222| state))) ; $procmux$701_Y
(define-fun |output_gate#224| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#223| state) #b0)) ; $assert$output_gate_properties.vh:147$371_EN
(define-fun |output_gate_a 8| ((state |output_gate_s|)) Bool (or (|output_gate#219| state) (not (= ((_ extract 0 0) (|output_gate#224| state)) #b1)))) ; _witness_.assert_assert_output_gate_properties_vh_147_371
(define-fun |output_gate#225| ((state |output_gate_s|)) (_ BitVec 16) (bvadd (|output_gate#15| state) #b0000000000000001)) ; $add$output_gate_properties.vh:15$379_Y
(define-fun |output_gate#226| ((state |output_gate_s|)) (_ BitVec 16) (ite (|output_gate#206| state) #b1111010000100100 (|output_gate#225| state))) ; $ternary$output_gate_properties.vh:15$380_Y
(define-fun |output_gate#227| ((state |output_gate_s|)) Bool (= (|output_gate#14| state) (|output_gate#226| state))) ; $eq$output_gate_properties.vh:148$382_Y
(define-fun |output_gate#228| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 1 1) (|output_gate#124| state)) #b1) false) (or  (|output_gate#227| state) false))) ; $logic_and$output_gate_properties.vh:148$383_Y
(define-fun |output_gate#229| ((state |output_gate_s|)) Bool (distinct (|output_gate#14| state) #b0000000000000000)) ; $ne$output_gate_properties.vh:148$374_Y
(define-fun |output_gate#230| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 0 0) (|output_gate#124| state)) #b1) false) (or  (|output_gate#229| state) false))) ; $logic_and$output_gate_properties.vh:148$375_Y
(define-fun |output_gate#231| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#230| state) #b1 #b0)) ; $procmux$690_Y
(define-fun |output_gate#232| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#23| state)) #b1) #b0 (|output_gate#231| state))) ; $procmux$692_Y
(define-fun |output_gate#233| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#232| state) #b0)) ; $assert$output_gate_properties.vh:148$381_EN
(define-fun |output_gate_a 9| ((state |output_gate_s|)) Bool (or (|output_gate#228| state) (not (= ((_ extract 0 0) (|output_gate#233| state)) #b1)))) ; _witness_.assert_assert_output_gate_properties_vh_148_381
(define-fun |output_gate#234| ((state |output_gate_s|)) (_ BitVec 16) (bvadd (|output_gate#16| state) #b0000000000000001)) ; $add$output_gate_properties.vh:15$389_Y
(define-fun |output_gate#235| ((state |output_gate_s|)) (_ BitVec 16) (ite (|output_gate#211| state) #b1111010000100100 (|output_gate#234| state))) ; $ternary$output_gate_properties.vh:15$390_Y
(define-fun |output_gate#236| ((state |output_gate_s|)) Bool (= (|output_gate#15| state) (|output_gate#235| state))) ; $eq$output_gate_properties.vh:149$392_Y
(define-fun |output_gate#237| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 2 2) (|output_gate#124| state)) #b1) false) (or  (|output_gate#236| state) false))) ; $logic_and$output_gate_properties.vh:149$393_Y
(define-fun |output_gate#238| ((state |output_gate_s|)) Bool (distinct (|output_gate#15| state) #b0000000000000000)) ; $ne$output_gate_properties.vh:149$384_Y
(define-fun |output_gate#239| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 1 1) (|output_gate#124| state)) #b1) false) (or  (|output_gate#238| state) false))) ; $logic_and$output_gate_properties.vh:149$385_Y
(define-fun |output_gate#240| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#239| state) #b1 #b0)) ; $procmux$681_Y
(define-fun |output_gate#241| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#23| state)) #b1) #b0 (|output_gate#240| state))) ; $procmux$683_Y
(define-fun |output_gate#242| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#241| state) #b0)) ; $assert$output_gate_properties.vh:149$391_EN
(define-fun |output_gate_a 10| ((state |output_gate_s|)) Bool (or (|output_gate#237| state) (not (= ((_ extract 0 0) (|output_gate#242| state)) #b1)))) ; _witness_.assert_assert_output_gate_properties_vh_149_391
(define-fun |output_gate#243| ((state |output_gate_s|)) (_ BitVec 16) (bvadd (|output_gate#17| state) #b0000000000000001)) ; $add$output_gate_properties.vh:15$399_Y
(define-fun |output_gate#244| ((state |output_gate_s|)) Bool (= (|output_gate#17| state) #b1111010000100100)) ; $eq$output_gate_properties.vh:146$362_Y
(define-fun |output_gate#245| ((state |output_gate_s|)) (_ BitVec 16) (ite (|output_gate#244| state) #b1111010000100100 (|output_gate#243| state))) ; $ternary$output_gate_properties.vh:15$400_Y
(define-fun |output_gate#246| ((state |output_gate_s|)) Bool (= (|output_gate#16| state) (|output_gate#245| state))) ; $eq$output_gate_properties.vh:150$402_Y
(define-fun |output_gate#247| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 0 0) (|output_gate#27| state)) #b1) false) (or  (|output_gate#246| state) false))) ; $logic_and$output_gate_properties.vh:150$403_Y
(define-fun |output_gate#248| ((state |output_gate_s|)) Bool (distinct (|output_gate#16| state) #b0000000000000000)) ; $ne$output_gate_properties.vh:150$394_Y
(define-fun |output_gate#249| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 2 2) (|output_gate#124| state)) #b1) false) (or  (|output_gate#248| state) false))) ; $logic_and$output_gate_properties.vh:150$395_Y
(define-fun |output_gate#250| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#249| state) #b1 #b0)) ; $procmux$672_Y
(define-fun |output_gate#251| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#23| state)) #b1) #b0 (|output_gate#250| state))) ; $procmux$674_Y
(define-fun |output_gate#252| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#251| state) #b0)) ; $assert$output_gate_properties.vh:150$401_EN
(define-fun |output_gate_a 11| ((state |output_gate_s|)) Bool (or (|output_gate#247| state) (not (= ((_ extract 0 0) (|output_gate#252| state)) #b1)))) ; _witness_.assert_assert_output_gate_properties_vh_150_401
(define-fun |output_gate#253| ((state |output_gate_s|)) Bool (bvuge (|output_gate#177| state) (|output_gate#17| state))) ; $ge$output_gate_properties.vh:151$405_Y
(define-fun |output_gate#254| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#27| state)) #b1) #b1 #b0)) ; $procmux$663_Y
(define-fun |output_gate#255| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#23| state)) #b1) #b0 (|output_gate#254| state))) ; $procmux$665_Y
(define-fun |output_gate#256| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#255| state) #b0)) ; $assert$output_gate_properties.vh:151$404_EN
(define-fun |output_gate_a 12| ((state |output_gate_s|)) Bool (or (|output_gate#253| state) (not (= ((_ extract 0 0) (|output_gate#256| state)) #b1)))) ; _witness_.assert_assert_output_gate_properties_vh_151_404
(define-fun |output_gate#257| ((state |output_gate_s|)) Bool (|output_gate_is| state)) ; $auto$rtlil.cc:3293:And$1056
(define-fun |output_gate_u 1| ((state |output_gate_s|)) Bool (or (|output_gate#150| state) (not (|output_gate#257| state)))) ; _witness_.assume_assume_output_gate_properties_vh_41_408
(define-fun |output_gate#258| ((state |output_gate_s|)) (_ BitVec 32) (bvadd (|output_gate#93| state) #b00000000000000000000000000000001)) ; $add$output_gate_properties.vh:110$242_Y
(define-fun |output_gate#259| ((state |output_gate_s|)) Bool (= (|output_gate#94| state) (|output_gate#258| state))) ; $eq$output_gate_properties.vh:110$243_Y
(define-fun |output_gate#260| ((state |output_gate_s|)) Bool (= (|output_gate#96| state) (|output_gate#122| state))) ; $eq$output_gate_properties.vh:110$244_Y
(define-fun |output_gate#261| ((state |output_gate_s|)) Bool (and (or  (|output_gate#259| state) false) (or  (|output_gate#260| state) false))) ; $logic_and$output_gate_properties.vh:110$245_Y
(define-fun |output_gate_a 13| ((state |output_gate_s|)) Bool (or (|output_gate#261| state) (not (= ((_ extract 0 0) (|output_gate#9| state)) #b1)))) ; a_fault_is_counted
(define-fun |output_gate#262| ((state |output_gate_s|)) Bool (distinct ((_ extract 8 4) (|output_gate#95| state)) #b00000)) ; $ne$output_gate_properties.vh:121$271_Y
(define-fun |output_gate_a 14| ((state |output_gate_s|)) Bool (or (|output_gate#262| state) (not (= ((_ extract 0 0) (|output_gate#13| state)) #b1)))) ; a_limit_rests
(define-fun |output_gate#263| ((state |output_gate_s|)) Bool (distinct (concat #b0000000 (|output_gate#95| state)) #b0000000000000000)) ; $ne$output_gate_properties.vh:136$321_Y
(define-fun |output_gate#264| ((state |output_gate_s|)) Bool (= (|output_gate#97| state) (ite (|output_gate#263| state) #b1 #b0))) ; $eq$output_gate_properties.vh:136$322_Y
(define-fun |output_gate_a 15| ((state |output_gate_s|)) Bool (or (|output_gate#264| state) (not (= ((_ extract 0 0) (|output_gate#36| state)) #b1)))) ; any_is_known
(define-fun |output_gate#265| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#95| state)) #b1) (= ((_ extract 1 1) (|output_gate#95| state)) #b1) (= ((_ extract 2 2) (|output_gate#95| state)) #b1) (= ((_ extract 3 3) (|output_gate#95| state)) #b1) (= ((_ extract 4 4) (|output_gate#95| state)) #b1) (= ((_ extract 5 5) (|output_gate#95| state)) #b1) (= ((_ extract 6 6) (|output_gate#95| state)) #b1) (= ((_ extract 7 7) (|output_gate#95| state)) #b1) (= ((_ extract 8 8) (|output_gate#95| state)) #b1) false false false false false false false))) ; $eq$output_gate_properties.vh:117$259_Y
(define-fun |output_gate#266| ((state |output_gate_s|)) Bool (and (or  (|output_gate#90| state) false) (or  (|output_gate#265| state) false))) ; $logic_and$output_gate_properties.vh:36$92_Y
(define-fun |output_gate#267| ((state |output_gate_s|)) Bool (and (or  (|output_gate#266| state) false) (or  (|output_gate#47| state) false))) ; $logic_and$output_gate_properties.vh:36$93_Y
(define-fun |output_gate#268| ((state |output_gate_s|)) Bool (and (or  (|output_gate#267| state) false) (or  (|output_gate#49| state) false))) ; $logic_and$output_gate_properties.vh:36$94_Y
(define-fun |output_gate#269| ((state |output_gate_s|)) Bool (and (or  (|output_gate#268| state) false) (or  (|output_gate#102| state) false))) ; $logic_and$output_gate_properties.vh:36$95_Y
(define-fun |output_gate_u 2| ((state |output_gate_s|)) Bool (or (|output_gate#269| state) (not (= ((_ extract 0 0) (|output_gate#39| state)) #b1)))) ; arm_is_allowed
(define-fun |output_gate#270| ((state |output_gate_s|)) Bool (not (or  (|output_gate#34| state) false))) ; $logic_not$output_gate_properties.vh:87$199_Y
(define-fun |output_gate_a 16| ((state |output_gate_s|)) Bool (or (|output_gate#270| state) (not (= ((_ extract 0 0) (|output_gate#45| state)) #b1)))) ; beyond_is_off
(define-fun |output_gate#271| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#23| state)) #b1) false))) ; $logic_not$output_gate_properties.vh:38$96_Y
(define-fun |output_gate#272| ((state |output_gate_s|)) Bool (or  (|output_gate#271| state) false  (|output_gate#150| state) false)) ; $logic_or$output_gate_properties.vh:38$97_Y
(define-fun |output_gate_u 3| ((state |output_gate_s|)) Bool (or (|output_gate#272| state) (not true))) ; clock_is_lost_in_reset
(define-fun |output_gate#273| ((state |output_gate_s|)) Bool (= (|output_gate#94| state) (|output_gate#93| state))) ; $eq$output_gate_properties.vh:111$246_Y
(define-fun |output_gate_a 17| ((state |output_gate_s|)) Bool (or (|output_gate#273| state) (not (= ((_ extract 0 0) (|output_gate#61| state)) #b1)))) ; counted_once
(define-fun |output_gate#274| ((state |output_gate_s|)) Bool (or  (|output_gate#90| state) false  (|output_gate#85| state) false)) ; $logic_or$output_gate_properties.vh:113$256_Y
(define-fun |output_gate#275| ((state |output_gate_s|)) Bool (or  (|output_gate#274| state) false  (|output_gate#87| state) false)) ; $logic_or$output_gate_properties.vh:113$258_Y
(define-fun |output_gate_a 18| ((state |output_gate_s|)) Bool (or (|output_gate#275| state) (not (= ((_ extract 0 0) (|output_gate#68| state)) #b1)))) ; disarm_is_obeyed
(define-fun |output_gate_a 19| ((state |output_gate_s|)) Bool (or (|output_gate#275| state) (not (= ((_ extract 0 0) (|output_gate#71| state)) #b1)))) ; disarmed_for_good
(define-fun |output_gate#276| ((state |output_gate_s|)) (_ BitVec 32) (bvnot (concat #b000000000000000000000000000 ((_ extract 8 4) (|output_gate#95| state))))) ; $not$output_gate_properties.vh:103$227_Y
(define-fun |output_gate#277| ((state |output_gate_s|)) (_ BitVec 32) (bvand (concat #b000000000000000000000000000 (|output_gate#74| state)) (|output_gate#276| state))) ; $and$output_gate_properties.vh:109$238_Y
(define-fun |output_gate#278| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#277| state)) #b1) (= ((_ extract 1 1) (|output_gate#277| state)) #b1) (= ((_ extract 2 2) (|output_gate#277| state)) #b1) (= ((_ extract 3 3) (|output_gate#277| state)) #b1) (= ((_ extract 4 4) (|output_gate#277| state)) #b1) (= ((_ extract 5 5) (|output_gate#277| state)) #b1) (= ((_ extract 6 6) (|output_gate#277| state)) #b1) (= ((_ extract 7 7) (|output_gate#277| state)) #b1) (= ((_ extract 8 8) (|output_gate#277| state)) #b1) (= ((_ extract 9 9) (|output_gate#277| state)) #b1) (= ((_ extract 10 10) (|output_gate#277| state)) #b1) (= ((_ extract 11 11) (|output_gate#277| state)) #b1) (= ((_ extract 12 12) (|output_gate#277| state)) #b1) (= ((_ extract 13 13) (|output_gate#277| state)) #b1) (= ((_ extract 14 14) (|output_gate#277| state)) #b1) (= ((_ extract 15 15) (|output_gate#277| state)) #b1) (= ((_ extract 16 16) (|output_gate#277| state)) #b1) (= ((_ extract 17 17) (|output_gate#277| state)) #b1) (= ((_ extract 18 18) (|output_gate#277| state)) #b1) (= ((_ extract 19 19) (|output_gate#277| state)) #b1) (= ((_ extract 20 20) (|output_gate#277| state)) #b1) (= ((_ extract 21 21) (|output_gate#277| state)) #b1) (= ((_ extract 22 22) (|output_gate#277| state)) #b1) (= ((_ extract 23 23) (|output_gate#277| state)) #b1) (= ((_ extract 24 24) (|output_gate#277| state)) #b1) (= ((_ extract 25 25) (|output_gate#277| state)) #b1) (= ((_ extract 26 26) (|output_gate#277| state)) #b1) (= ((_ extract 27 27) (|output_gate#277| state)) #b1) (= ((_ extract 28 28) (|output_gate#277| state)) #b1) (= ((_ extract 29 29) (|output_gate#277| state)) #b1) (= ((_ extract 30 30) (|output_gate#277| state)) #b1) (= ((_ extract 31 31) (|output_gate#277| state)) #b1)))) ; $eq$output_gate_properties.vh:109$239_Y
(define-fun |output_gate_a 20| ((state |output_gate_s|)) Bool (or (|output_gate#278| state) (not (= ((_ extract 0 0) (|output_gate#76| state)) #b1)))) ; edges_are_kept
(define-fun |output_gate#279| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 0 0) (|output_gate#27| state)) #b1) false) (or  (|output_gate#244| state) false))) ; $logic_and$output_gate_properties.vh:146$363_Y
(define-fun |output_gate_a 21| ((state |output_gate_s|)) Bool (or (|output_gate#279| state) (not (= ((_ extract 0 0) (|output_gate#79| state)) #b1)))) ; edges_once_settled
(define-fun |output_gate_a 22| ((state |output_gate_s|)) Bool (or (= ((_ extract 2 2) (|output_gate#95| state)) #b1) (not (= ((_ extract 0 0) (|output_gate#109| state)) #b1)))) ; heat_is_kept
(define-fun |output_gate_a 23| ((state |output_gate_s|)) Bool (or (|output_gate#270| state) (not (= ((_ extract 0 0) (|output_gate#110| state)) #b1)))) ; hot_is_off
(define-fun |output_gate#280| ((state |output_gate_s|)) (_ BitVec 32) (bvand (concat #b000000000000000000000000000 (|output_gate#42| state)) (|output_gate#276| state))) ; $and$output_gate_properties.vh:103$228_Y
(define-fun |output_gate#281| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#280| state)) #b1) (= ((_ extract 1 1) (|output_gate#280| state)) #b1) (= ((_ extract 2 2) (|output_gate#280| state)) #b1) (= ((_ extract 3 3) (|output_gate#280| state)) #b1) (= ((_ extract 4 4) (|output_gate#280| state)) #b1) (= ((_ extract 5 5) (|output_gate#280| state)) #b1) (= ((_ extract 6 6) (|output_gate#280| state)) #b1) (= ((_ extract 7 7) (|output_gate#280| state)) #b1) (= ((_ extract 8 8) (|output_gate#280| state)) #b1) (= ((_ extract 9 9) (|output_gate#280| state)) #b1) (= ((_ extract 10 10) (|output_gate#280| state)) #b1) (= ((_ extract 11 11) (|output_gate#280| state)) #b1) (= ((_ extract 12 12) (|output_gate#280| state)) #b1) (= ((_ extract 13 13) (|output_gate#280| state)) #b1) (= ((_ extract 14 14) (|output_gate#280| state)) #b1) (= ((_ extract 15 15) (|output_gate#280| state)) #b1) (= ((_ extract 16 16) (|output_gate#280| state)) #b1) (= ((_ extract 17 17) (|output_gate#280| state)) #b1) (= ((_ extract 18 18) (|output_gate#280| state)) #b1) (= ((_ extract 19 19) (|output_gate#280| state)) #b1) (= ((_ extract 20 20) (|output_gate#280| state)) #b1) (= ((_ extract 21 21) (|output_gate#280| state)) #b1) (= ((_ extract 22 22) (|output_gate#280| state)) #b1) (= ((_ extract 23 23) (|output_gate#280| state)) #b1) (= ((_ extract 24 24) (|output_gate#280| state)) #b1) (= ((_ extract 25 25) (|output_gate#280| state)) #b1) (= ((_ extract 26 26) (|output_gate#280| state)) #b1) (= ((_ extract 27 27) (|output_gate#280| state)) #b1) (= ((_ extract 28 28) (|output_gate#280| state)) #b1) (= ((_ extract 29 29) (|output_gate#280| state)) #b1) (= ((_ extract 30 30) (|output_gate#280| state)) #b1) (= ((_ extract 31 31) (|output_gate#280| state)) #b1)))) ; $eq$output_gate_properties.vh:103$229_Y
(define-fun |output_gate_a 24| ((state |output_gate_s|)) Bool (or (|output_gate#281| state) (not (= ((_ extract 0 0) (|output_gate#112| state)) #b1)))) ; limits_are_kept
(define-fun |output_gate#282| ((state |output_gate_s|)) Bool (distinct (|output_gate#124| state) #b000)) ; $ne$output_gate.v:138$52_Y
(define-fun |output_gate#283| ((state |output_gate_s|)) Bool (or  (|output_gate#89| state) false  (|output_gate#282| state) false)) ; $logic_or$output_gate.v:138$53_Y
(define-fun |output_gate#284| ((state |output_gate_s|)) Bool (or  (|output_gate#283| state) false  (= ((_ extract 0 0) (|output_gate#27| state)) #b1) false)) ; $logic_or$output_gate_properties.vh:134$316_Y
(define-fun |output_gate#285| ((state |output_gate_s|)) Bool (= (|output_gate#52| state) (ite (|output_gate#284| state) #b1 #b0))) ; $eq$output_gate_properties.vh:134$317_Y
(define-fun |output_gate_a 25| ((state |output_gate_s|)) Bool (or (|output_gate#285| state) (not (= ((_ extract 0 0) (|output_gate#36| state)) #b1)))) ; live_is_anything_on
(define-fun |output_gate#286| ((state |output_gate_s|)) (_ BitVec 32) (bvnot (|output_gate#113| state))) ; $not$output_gate_properties.vh:95$216_Y
(define-fun |output_gate#287| ((state |output_gate_s|)) (_ BitVec 32) (bvand (|output_gate#24| state) (|output_gate#286| state))) ; $and$output_gate_properties.vh:95$217_Y
(define-fun |output_gate#288| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#287| state)) #b1) (= ((_ extract 1 1) (|output_gate#287| state)) #b1) (= ((_ extract 2 2) (|output_gate#287| state)) #b1) (= ((_ extract 3 3) (|output_gate#287| state)) #b1) (= ((_ extract 4 4) (|output_gate#287| state)) #b1) (= ((_ extract 5 5) (|output_gate#287| state)) #b1) (= ((_ extract 6 6) (|output_gate#287| state)) #b1) (= ((_ extract 7 7) (|output_gate#287| state)) #b1) (= ((_ extract 8 8) (|output_gate#287| state)) #b1) (= ((_ extract 9 9) (|output_gate#287| state)) #b1) (= ((_ extract 10 10) (|output_gate#287| state)) #b1) (= ((_ extract 11 11) (|output_gate#287| state)) #b1) (= ((_ extract 12 12) (|output_gate#287| state)) #b1) (= ((_ extract 13 13) (|output_gate#287| state)) #b1) (= ((_ extract 14 14) (|output_gate#287| state)) #b1) (= ((_ extract 15 15) (|output_gate#287| state)) #b1) (= ((_ extract 16 16) (|output_gate#287| state)) #b1) (= ((_ extract 17 17) (|output_gate#287| state)) #b1) (= ((_ extract 18 18) (|output_gate#287| state)) #b1) (= ((_ extract 19 19) (|output_gate#287| state)) #b1) (= ((_ extract 20 20) (|output_gate#287| state)) #b1) (= ((_ extract 21 21) (|output_gate#287| state)) #b1) (= ((_ extract 22 22) (|output_gate#287| state)) #b1) (= ((_ extract 23 23) (|output_gate#287| state)) #b1) (= ((_ extract 24 24) (|output_gate#287| state)) #b1) (= ((_ extract 25 25) (|output_gate#287| state)) #b1) (= ((_ extract 26 26) (|output_gate#287| state)) #b1) (= ((_ extract 27 27) (|output_gate#287| state)) #b1) (= ((_ extract 28 28) (|output_gate#287| state)) #b1) (= ((_ extract 29 29) (|output_gate#287| state)) #b1) (= ((_ extract 30 30) (|output_gate#287| state)) #b1) (= ((_ extract 31 31) (|output_gate#287| state)) #b1)))) ; $eq$output_gate_properties.vh:95$218_Y
(define-fun |output_gate_a 26| ((state |output_gate_s|)) Bool (or (|output_gate#288| state) (not (= ((_ extract 0 0) (|output_gate#114| state)) #b1)))) ; mask_is_kept
(define-fun |output_gate#289| ((state |output_gate_s|)) Bool (= (|output_gate#18| state) #b1111010000100100)) ; $eq$output_gate_properties.vh:142$351_Y
(define-fun |output_gate_a 27| ((state |output_gate_s|)) Bool (or (|output_gate#289| state) (not (= ((_ extract 0 0) (|output_gate#118| state)) #b1)))) ; moves_once_settled
(define-fun |output_gate#290| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#24| state)) #b1) (= ((_ extract 1 1) (|output_gate#24| state)) #b1) (= ((_ extract 2 2) (|output_gate#24| state)) #b1) (= ((_ extract 3 3) (|output_gate#24| state)) #b1) (= ((_ extract 4 4) (|output_gate#24| state)) #b1) (= ((_ extract 5 5) (|output_gate#24| state)) #b1) (= ((_ extract 6 6) (|output_gate#24| state)) #b1) (= ((_ extract 7 7) (|output_gate#24| state)) #b1) (= ((_ extract 8 8) (|output_gate#24| state)) #b1) (= ((_ extract 9 9) (|output_gate#24| state)) #b1) (= ((_ extract 10 10) (|output_gate#24| state)) #b1) (= ((_ extract 11 11) (|output_gate#24| state)) #b1) (= ((_ extract 12 12) (|output_gate#24| state)) #b1) (= ((_ extract 13 13) (|output_gate#24| state)) #b1) (= ((_ extract 14 14) (|output_gate#24| state)) #b1) (= ((_ extract 15 15) (|output_gate#24| state)) #b1) (= ((_ extract 16 16) (|output_gate#24| state)) #b1) (= ((_ extract 17 17) (|output_gate#24| state)) #b1) (= ((_ extract 18 18) (|output_gate#24| state)) #b1) (= ((_ extract 19 19) (|output_gate#24| state)) #b1) (= ((_ extract 20 20) (|output_gate#24| state)) #b1) (= ((_ extract 21 21) (|output_gate#24| state)) #b1) (= ((_ extract 22 22) (|output_gate#24| state)) #b1) (= ((_ extract 23 23) (|output_gate#24| state)) #b1) (= ((_ extract 24 24) (|output_gate#24| state)) #b1) (= ((_ extract 25 25) (|output_gate#24| state)) #b1) (= ((_ extract 26 26) (|output_gate#24| state)) #b1) (= ((_ extract 27 27) (|output_gate#24| state)) #b1) (= ((_ extract 28 28) (|output_gate#24| state)) #b1) (= ((_ extract 29 29) (|output_gate#24| state)) #b1) (= ((_ extract 30 30) (|output_gate#24| state)) #b1) (= ((_ extract 31 31) (|output_gate#24| state)) #b1)))) ; $eq$output_gate_properties.vh:124$278_Y
(define-fun |output_gate#291| ((state |output_gate_s|)) Bool (or  (|output_gate#290| state) false  (= ((_ extract 0 0) (|output_gate#27| state)) #b1) false)) ; $logic_or$output_gate_properties.vh:124$279_Y
(define-fun |output_gate_a 28| ((state |output_gate_s|)) Bool (or (|output_gate#291| state) (not (= ((_ extract 0 0) (|output_gate#114| state)) #b1)))) ; no_channel_alone
(define-fun |output_gate#292| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#27| state)) #b1) false))) ; $logic_not$output_gate_properties.vh:45$100_Y
(define-fun |output_gate#293| ((state |output_gate_s|)) Bool (and (or  (|output_gate#290| state) false) (or  (|output_gate#292| state) false))) ; $logic_and$output_gate_properties.vh:45$101_Y
(define-fun |output_gate#294| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#30| state)) #b1) false))) ; $logic_not$output_gate_properties.vh:125$280_Y
(define-fun |output_gate#295| ((state |output_gate_s|)) Bool (and (or  (|output_gate#293| state) false) (or  (|output_gate#294| state) false))) ; $logic_and$output_gate_properties.vh:45$103_Y
(define-fun |output_gate#296| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#33| state)) #b1) false))) ; $logic_not$output_gate_properties.vh:125$281_Y
(define-fun |output_gate#297| ((state |output_gate_s|)) Bool (and (or  (|output_gate#295| state) false) (or  (|output_gate#296| state) false))) ; $logic_and$output_gate_properties.vh:45$105_Y
(define-fun |output_gate_a 29| ((state |output_gate_s|)) Bool (or (|output_gate#297| state) (not (= ((_ extract 0 0) (|output_gate#119| state)) #b1)))) ; no_clock_is_off
(define-fun |output_gate#298| ((state |output_gate_s|)) Bool (and (or  (|output_gate#294| state) false) (or  (|output_gate#296| state) false))) ; $logic_and$output_gate_properties.vh:125$282_Y
(define-fun |output_gate#299| ((state |output_gate_s|)) Bool (or  (= ((_ extract 0 0) (|output_gate#27| state)) #b1) false  (|output_gate#298| state) false)) ; $logic_or$output_gate_properties.vh:125$283_Y
(define-fun |output_gate_a 30| ((state |output_gate_s|)) Bool (or (|output_gate#299| state) (not (= ((_ extract 0 0) (|output_gate#114| state)) #b1)))) ; no_sign_of_life_alone
(define-fun |output_gate_a 31| ((state |output_gate_s|)) Bool (or (|output_gate#270| state) (not (= ((_ extract 0 0) (|output_gate#121| state)) #b1)))) ; nonsense_is_off
(define-fun |output_gate_a 32| ((state |output_gate_s|)) Bool (or (= ((_ extract 0 0) (|output_gate#22| state)) #b1) (not (= ((_ extract 0 0) (|output_gate#126| state)) #b1)))) ; on_once_armed
(define-fun |output_gate#300| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 0 0) (|output_gate#99| state)) #b1) false) (or  (|output_gate#199| state) false))) ; $logic_and$output_gate_properties.vh:119$269_Y
(define-fun |output_gate_a 33| ((state |output_gate_s|)) Bool (or (|output_gate#300| state) (not (= ((_ extract 0 0) (|output_gate#126| state)) #b1)))) ; on_while_fed
(define-fun |output_gate_a 34| ((state |output_gate_s|)) Bool (or (|output_gate#265| state) (not (= ((_ extract 0 0) (|output_gate#126| state)) #b1)))) ; on_without_fault
(define-fun |output_gate#301| ((state |output_gate_s|)) (_ BitVec 32) (bvnot (concat #b0000000000000000 (|output_gate#2| state)))) ; $not$output_gate_properties.vh:112$249_Y
(define-fun |output_gate#302| ((state |output_gate_s|)) (_ BitVec 32) (bvand (concat #b00000000000000000000000 (|output_gate#95| state)) (|output_gate#301| state))) ; $and$output_gate_properties.vh:112$250_Y
(define-fun |output_gate#303| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#302| state)) #b1) (= ((_ extract 1 1) (|output_gate#302| state)) #b1) (= ((_ extract 2 2) (|output_gate#302| state)) #b1) (= ((_ extract 3 3) (|output_gate#302| state)) #b1) (= ((_ extract 4 4) (|output_gate#302| state)) #b1) (= ((_ extract 5 5) (|output_gate#302| state)) #b1) (= ((_ extract 6 6) (|output_gate#302| state)) #b1) (= ((_ extract 7 7) (|output_gate#302| state)) #b1) (= ((_ extract 8 8) (|output_gate#302| state)) #b1) (= ((_ extract 9 9) (|output_gate#302| state)) #b1) (= ((_ extract 10 10) (|output_gate#302| state)) #b1) (= ((_ extract 11 11) (|output_gate#302| state)) #b1) (= ((_ extract 12 12) (|output_gate#302| state)) #b1) (= ((_ extract 13 13) (|output_gate#302| state)) #b1) (= ((_ extract 14 14) (|output_gate#302| state)) #b1) (= ((_ extract 15 15) (|output_gate#302| state)) #b1) (= ((_ extract 16 16) (|output_gate#302| state)) #b1) (= ((_ extract 17 17) (|output_gate#302| state)) #b1) (= ((_ extract 18 18) (|output_gate#302| state)) #b1) (= ((_ extract 19 19) (|output_gate#302| state)) #b1) (= ((_ extract 20 20) (|output_gate#302| state)) #b1) (= ((_ extract 21 21) (|output_gate#302| state)) #b1) (= ((_ extract 22 22) (|output_gate#302| state)) #b1) (= ((_ extract 23 23) (|output_gate#302| state)) #b1) (= ((_ extract 24 24) (|output_gate#302| state)) #b1) (= ((_ extract 25 25) (|output_gate#302| state)) #b1) (= ((_ extract 26 26) (|output_gate#302| state)) #b1) (= ((_ extract 27 27) (|output_gate#302| state)) #b1) (= ((_ extract 28 28) (|output_gate#302| state)) #b1) (= ((_ extract 29 29) (|output_gate#302| state)) #b1) (= ((_ extract 30 30) (|output_gate#302| state)) #b1) (= ((_ extract 31 31) (|output_gate#302| state)) #b1)))) ; $eq$output_gate_properties.vh:112$251_Y
(define-fun |output_gate_a 35| ((state |output_gate_s|)) Bool (or (|output_gate#303| state) (not (= ((_ extract 0 0) (|output_gate#129| state)) #b1)))) ; only_a_cause_is_kept
(define-fun |output_gate#304| ((state |output_gate_s|)) (_ BitVec 32) (bvnot (concat #b00000000000000000000000 (|output_gate#95| state)))) ; $not$output_gate_properties.vh:107$233_Y
(define-fun |output_gate#305| ((state |output_gate_s|)) (_ BitVec 32) (bvand (concat #b0000000000000000 (|output_gate#2| state)) (|output_gate#304| state))) ; $and$output_gate_properties.vh:107$234_Y
(define-fun |output_gate#306| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#305| state)) #b1) (= ((_ extract 1 1) (|output_gate#305| state)) #b1) (= ((_ extract 2 2) (|output_gate#305| state)) #b1) (= ((_ extract 3 3) (|output_gate#305| state)) #b1) (= ((_ extract 4 4) (|output_gate#305| state)) #b1) (= ((_ extract 5 5) (|output_gate#305| state)) #b1) (= ((_ extract 6 6) (|output_gate#305| state)) #b1) (= ((_ extract 7 7) (|output_gate#305| state)) #b1) (= ((_ extract 8 8) (|output_gate#305| state)) #b1) (= ((_ extract 9 9) (|output_gate#305| state)) #b1) (= ((_ extract 10 10) (|output_gate#305| state)) #b1) (= ((_ extract 11 11) (|output_gate#305| state)) #b1) (= ((_ extract 12 12) (|output_gate#305| state)) #b1) (= ((_ extract 13 13) (|output_gate#305| state)) #b1) (= ((_ extract 14 14) (|output_gate#305| state)) #b1) (= ((_ extract 15 15) (|output_gate#305| state)) #b1) (= ((_ extract 16 16) (|output_gate#305| state)) #b1) (= ((_ extract 17 17) (|output_gate#305| state)) #b1) (= ((_ extract 18 18) (|output_gate#305| state)) #b1) (= ((_ extract 19 19) (|output_gate#305| state)) #b1) (= ((_ extract 20 20) (|output_gate#305| state)) #b1) (= ((_ extract 21 21) (|output_gate#305| state)) #b1) (= ((_ extract 22 22) (|output_gate#305| state)) #b1) (= ((_ extract 23 23) (|output_gate#305| state)) #b1) (= ((_ extract 24 24) (|output_gate#305| state)) #b1) (= ((_ extract 25 25) (|output_gate#305| state)) #b1) (= ((_ extract 26 26) (|output_gate#305| state)) #b1) (= ((_ extract 27 27) (|output_gate#305| state)) #b1) (= ((_ extract 28 28) (|output_gate#305| state)) #b1) (= ((_ extract 29 29) (|output_gate#305| state)) #b1) (= ((_ extract 30 30) (|output_gate#305| state)) #b1) (= ((_ extract 31 31) (|output_gate#305| state)) #b1)))) ; $eq$output_gate_properties.vh:107$235_Y
(define-fun |output_gate_a 36| ((state |output_gate_s|)) Bool (or (|output_gate#306| state) (not (= ((_ extract 0 0) (|output_gate#132| state)) #b1)))) ; only_a_command_clears
(define-fun |output_gate#307| ((state |output_gate_s|)) (_ BitVec 32) (bvnot (|output_gate#72| state))) ; $not$output_gate_properties.vh:96$219_Y
(define-fun |output_gate#308| ((state |output_gate_s|)) (_ BitVec 32) (bvand (|output_gate#24| state) (|output_gate#307| state))) ; $and$output_gate_properties.vh:96$220_Y
(define-fun |output_gate#309| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#308| state)) #b1) (= ((_ extract 1 1) (|output_gate#308| state)) #b1) (= ((_ extract 2 2) (|output_gate#308| state)) #b1) (= ((_ extract 3 3) (|output_gate#308| state)) #b1) (= ((_ extract 4 4) (|output_gate#308| state)) #b1) (= ((_ extract 5 5) (|output_gate#308| state)) #b1) (= ((_ extract 6 6) (|output_gate#308| state)) #b1) (= ((_ extract 7 7) (|output_gate#308| state)) #b1) (= ((_ extract 8 8) (|output_gate#308| state)) #b1) (= ((_ extract 9 9) (|output_gate#308| state)) #b1) (= ((_ extract 10 10) (|output_gate#308| state)) #b1) (= ((_ extract 11 11) (|output_gate#308| state)) #b1) (= ((_ extract 12 12) (|output_gate#308| state)) #b1) (= ((_ extract 13 13) (|output_gate#308| state)) #b1) (= ((_ extract 14 14) (|output_gate#308| state)) #b1) (= ((_ extract 15 15) (|output_gate#308| state)) #b1) (= ((_ extract 16 16) (|output_gate#308| state)) #b1) (= ((_ extract 17 17) (|output_gate#308| state)) #b1) (= ((_ extract 18 18) (|output_gate#308| state)) #b1) (= ((_ extract 19 19) (|output_gate#308| state)) #b1) (= ((_ extract 20 20) (|output_gate#308| state)) #b1) (= ((_ extract 21 21) (|output_gate#308| state)) #b1) (= ((_ extract 22 22) (|output_gate#308| state)) #b1) (= ((_ extract 23 23) (|output_gate#308| state)) #b1) (= ((_ extract 24 24) (|output_gate#308| state)) #b1) (= ((_ extract 25 25) (|output_gate#308| state)) #b1) (= ((_ extract 26 26) (|output_gate#308| state)) #b1) (= ((_ extract 27 27) (|output_gate#308| state)) #b1) (= ((_ extract 28 28) (|output_gate#308| state)) #b1) (= ((_ extract 29 29) (|output_gate#308| state)) #b1) (= ((_ extract 30 30) (|output_gate#308| state)) #b1) (= ((_ extract 31 31) (|output_gate#308| state)) #b1)))) ; $eq$output_gate_properties.vh:96$221_Y
(define-fun |output_gate_a 37| ((state |output_gate_s|)) Bool (or (|output_gate#309| state) (not (= ((_ extract 0 0) (|output_gate#114| state)) #b1)))) ; only_what_is_played
(define-fun |output_gate#310| ((state |output_gate_s|)) Bool (and (or  (|output_gate#270| state) false) (or  (|output_gate#90| state) false))) ; $logic_and$output_gate_properties.vh:87$201_Y
(define-fun |output_gate#311| ((state |output_gate_s|)) Bool (and (or  (|output_gate#310| state) false) (or  (|output_gate#265| state) false))) ; $logic_and$output_gate_properties.vh:87$203_Y
(define-fun |output_gate#312| ((state |output_gate_s|)) Bool (and (or  (|output_gate#311| state) false) (or  (= ((_ extract 0 0) (|output_gate#20| state)) #b1) false))) ; $logic_and$output_gate_properties.vh:87$205_Y
(define-fun |output_gate_a 38| ((state |output_gate_s|)) Bool (or (|output_gate#312| state) (not (= ((_ extract 0 0) (|output_gate#139| state)) #b1)))) ; reset_is_off
(define-fun |output_gate#313| ((state |output_gate_s|)) Bool (= (|output_gate#140| state) (ite (|output_gate#11| state) #b1 #b0))) ; $eq$output_gate_properties.vh:132$309_Y
(define-fun |output_gate#314| ((state |output_gate_s|)) Bool (bvule (|output_gate#10| state) #b00000000111011100110101100101000)) ; $le$output_gate_properties.vh:132$310_Y
(define-fun |output_gate#315| ((state |output_gate_s|)) Bool (and (or  (|output_gate#313| state) false) (or  (|output_gate#314| state) false))) ; $logic_and$output_gate_properties.vh:132$311_Y
(define-fun |output_gate_a 39| ((state |output_gate_s|)) Bool (or (|output_gate#315| state) (not (= ((_ extract 0 0) (|output_gate#36| state)) #b1)))) ; rest_has_its_time
(define-fun |output_gate#316| ((state |output_gate_s|)) (_ BitVec 32) (bvsub #b00000000111011100110101100101000 (|output_gate#10| state))) ; $sub$output_gate_properties.vh:133$312_Y
(define-fun |output_gate#317| ((state |output_gate_s|)) Bool (= (|output_gate#148| state) (|output_gate#316| state))) ; $eq$output_gate_properties.vh:133$313_Y
(define-fun |output_gate_a 40| ((state |output_gate_s|)) Bool (or (|output_gate#317| state) (not (= ((_ extract 0 0) (|output_gate#143| state)) #b1)))) ; rest_is_counted
(define-fun |output_gate#318| ((state |output_gate_s|)) (_ BitVec 32) (bvand (concat #b000000000000000000000000000 (|output_gate#98| state)) (|output_gate#276| state))) ; $and$output_gate_properties.vh:122$276_Y
(define-fun |output_gate#319| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#318| state)) #b1) (= ((_ extract 1 1) (|output_gate#318| state)) #b1) (= ((_ extract 2 2) (|output_gate#318| state)) #b1) (= ((_ extract 3 3) (|output_gate#318| state)) #b1) (= ((_ extract 4 4) (|output_gate#318| state)) #b1) (= ((_ extract 5 5) (|output_gate#318| state)) #b1) (= ((_ extract 6 6) (|output_gate#318| state)) #b1) (= ((_ extract 7 7) (|output_gate#318| state)) #b1) (= ((_ extract 8 8) (|output_gate#318| state)) #b1) (= ((_ extract 9 9) (|output_gate#318| state)) #b1) (= ((_ extract 10 10) (|output_gate#318| state)) #b1) (= ((_ extract 11 11) (|output_gate#318| state)) #b1) (= ((_ extract 12 12) (|output_gate#318| state)) #b1) (= ((_ extract 13 13) (|output_gate#318| state)) #b1) (= ((_ extract 14 14) (|output_gate#318| state)) #b1) (= ((_ extract 15 15) (|output_gate#318| state)) #b1) (= ((_ extract 16 16) (|output_gate#318| state)) #b1) (= ((_ extract 17 17) (|output_gate#318| state)) #b1) (= ((_ extract 18 18) (|output_gate#318| state)) #b1) (= ((_ extract 19 19) (|output_gate#318| state)) #b1) (= ((_ extract 20 20) (|output_gate#318| state)) #b1) (= ((_ extract 21 21) (|output_gate#318| state)) #b1) (= ((_ extract 22 22) (|output_gate#318| state)) #b1) (= ((_ extract 23 23) (|output_gate#318| state)) #b1) (= ((_ extract 24 24) (|output_gate#318| state)) #b1) (= ((_ extract 25 25) (|output_gate#318| state)) #b1) (= ((_ extract 26 26) (|output_gate#318| state)) #b1) (= ((_ extract 27 27) (|output_gate#318| state)) #b1) (= ((_ extract 28 28) (|output_gate#318| state)) #b1) (= ((_ extract 29 29) (|output_gate#318| state)) #b1) (= ((_ extract 30 30) (|output_gate#318| state)) #b1) (= ((_ extract 31 31) (|output_gate#318| state)) #b1)))) ; $eq$output_gate_properties.vh:122$277_Y
(define-fun |output_gate_a 41| ((state |output_gate_s|)) Bool (or (|output_gate#319| state) (not (= ((_ extract 0 0) (|output_gate#147| state)) #b1)))) ; rest_is_kept
(define-fun |output_gate#320| ((state |output_gate_s|)) Bool (bvult (|output_gate#18| state) #b1111010000100100)) ; $lt$output_gate_properties.vh:141$347_Y
(define-fun |output_gate#321| ((state |output_gate_s|)) (_ BitVec 16) (bvsub #b1111010000100011 (|output_gate#18| state))) ; $sub$output_gate_properties.vh:141$348_Y
(define-fun |output_gate#322| ((state |output_gate_s|)) Bool (= (|output_gate#151| state) (|output_gate#321| state))) ; $eq$output_gate_properties.vh:141$349_Y
(define-fun |output_gate#323| ((state |output_gate_s|)) Bool (and (or  (|output_gate#320| state) false) (or  (|output_gate#322| state) false))) ; $logic_and$output_gate_properties.vh:141$350_Y
(define-fun |output_gate_a 42| ((state |output_gate_s|)) Bool (or (|output_gate#323| state) (not (= ((_ extract 0 0) (|output_gate#155| state)) #b1)))) ; settling_is_counted
(define-fun |output_gate#324| ((state |output_gate_s|)) (_ BitVec 33) (bvadd (concat #b0 (|output_gate#164| state)) (concat #b0 (|output_gate#176| state)))) ; $add$output_gate_properties.vh:138$330_Y
(define-fun |output_gate#325| ((state |output_gate_s|)) Bool (= (|output_gate#324| state) (|output_gate#196| state))) ; $eq$output_gate_properties.vh:138$332_Y
(define-fun |output_gate#326| ((state |output_gate_s|)) Bool (= (|output_gate#164| state) (|output_gate#100| state))) ; $eq$output_gate_properties.vh:138$329_Y
(define-fun |output_gate#327| ((state |output_gate_s|)) Bool (= (|output_gate#176| state) #b00000000000000000000000000000001)) ; $eq$output_gate_properties.vh:138$328_Y
(define-fun |output_gate#328| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#327| state) (ite (|output_gate#326| state) #b1 #b0) (ite (|output_gate#325| state) #b1 #b0))) ; $ternary$output_gate_properties.vh:138$333_Y
(define-fun |output_gate_a 43| ((state |output_gate_s|)) Bool (or (= ((_ extract 0 0) (|output_gate#328| state)) #b1) (not (= ((_ extract 0 0) (|output_gate#159| state)) #b1)))) ; silence_is_counted
(define-fun |output_gate_a 44| ((state |output_gate_s|)) Bool (or (= ((_ extract 1 1) (|output_gate#95| state)) #b1) (not (= ((_ extract 0 0) (|output_gate#163| state)) #b1)))) ; silence_is_kept
(define-fun |output_gate#329| ((state |output_gate_s|)) Bool (bvule (|output_gate#176| state) (|output_gate#100| state))) ; $le$output_gate_properties.vh:139$335_Y
(define-fun |output_gate#330| ((state |output_gate_s|)) Bool (or  (|output_gate#329| state) false  (|output_gate#327| state) false)) ; $logic_or$output_gate_properties.vh:139$337_Y
(define-fun |output_gate_a 45| ((state |output_gate_s|)) Bool (or (|output_gate#330| state) (not (= ((_ extract 0 0) (|output_gate#159| state)) #b1)))) ; silent_in_time
(define-fun |output_gate_a 46| ((state |output_gate_s|)) Bool (or (|output_gate#270| state) (not (= ((_ extract 0 0) (|output_gate#165| state)) #b1)))) ; silent_is_off
(define-fun |output_gate_a 47| ((state |output_gate_s|)) Bool (or (= ((_ extract 0 0) (|output_gate#95| state)) #b1) (not (= ((_ extract 0 0) (|output_gate#168| state)) #b1)))) ; stop_is_kept
(define-fun |output_gate_a 48| ((state |output_gate_s|)) Bool (or (|output_gate#270| state) (not (= ((_ extract 0 0) (|output_gate#169| state)) #b1)))) ; stopped_is_off
(define-fun |output_gate#331| ((state |output_gate_s|)) Bool (bvuge (|output_gate#177| state) #b1111010000100100)) ; $ge$output_gate_properties.vh:126$285_Y
(define-fun |output_gate#332| ((state |output_gate_s|)) Bool (or  (|output_gate#290| state) false  (|output_gate#331| state) false)) ; $logic_or$output_gate_properties.vh:126$286_Y
(define-fun |output_gate_a 49| ((state |output_gate_s|)) Bool (or (|output_gate#332| state) (not (= ((_ extract 0 0) (|output_gate#114| state)) #b1)))) ; supply_has_settled
(define-fun |output_gate_a 50| ((state |output_gate_s|)) Bool (or (= ((_ extract 3 3) (|output_gate#95| state)) #b1) (not (= ((_ extract 0 0) (|output_gate#173| state)) #b1)))) ; underrun_is_kept
(define-fun |output_gate_a 51| ((state |output_gate_s|)) Bool (or (|output_gate#270| state) (not (= ((_ extract 0 0) (|output_gate#174| state)) #b1)))) ; underrun_is_off
(define-fun |output_gate#333| ((state |output_gate_s|)) (_ BitVec 16) (bvadd (|output_gate#177| state) #b0000000000000001)) ; $add$output_gate_properties.vh:15$138_Y
(define-fun |output_gate#334| ((state |output_gate_s|)) Bool (= (|output_gate#177| state) #b1111010000100100)) ; $eq$output_gate_properties.vh:15$137_Y
(define-fun |output_gate#335| ((state |output_gate_s|)) (_ BitVec 16) (ite (|output_gate#334| state) #b1111010000100100 (|output_gate#333| state))) ; $0\longer$func$output_gate_properties.vh:65$2.$result[15:0]$109
(define-fun |output_gate#336| ((state |output_gate_s|)) Bool (or  (|output_gate#150| state) false  (|output_gate#292| state) false)) ; $logic_or$output_gate_properties.vh:65$141_Y
(define-fun |output_gate#337| ((state |output_gate_s|)) (_ BitVec 16) (ite (|output_gate#336| state) #b0000000000000000 (|output_gate#335| state))) ; $0\up_q[15:0]
(define-fun |output_gate#338| ((state |output_gate_s|)) (_ BitVec 32) (bvadd (|output_gate#176| state) #b00000000000000000000000000000001)) ; $add$output_gate_properties.vh:79$166_Y
(define-fun |output_gate#339| ((state |output_gate_s|)) Bool (= (|output_gate#176| state) #b11111111111111111111111111111111)) ; $eq$output_gate_properties.vh:79$165_Y
(define-fun |output_gate#340| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#339| state) (|output_gate#176| state) (|output_gate#338| state))) ; $ternary$output_gate_properties.vh:79$167_Y
(define-fun |output_gate#341| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#102| state) #b00000000000000000000000000000001 (|output_gate#340| state))) ; $0\unfed_q[31:0]
(define-fun |output_gate#342| ((state |output_gate_s|)) (_ BitVec 32) (bvadd (|output_gate#175| state) #b00000000000000000000000000000001)) ; $add$output_gate.v:122$44_Y
(define-fun |output_gate#343| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 0 0) (|output_gate#52| state)) #b1) false) (or  (= ((_ extract 0 0) (|output_gate#51| state)) #b1) false))) ; $logic_and$output_gate.v:122$43_Y
(define-fun |output_gate#344| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#343| state) (|output_gate#342| state) (|output_gate#175| state))) ; $procmux$447_Y
(define-fun |output_gate#345| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#150| state) #b00000000000000000000000000000000 (|output_gate#344| state))) ; $0\underruns_q[31:0]
(define-fun |output_gate#346| ((state |output_gate_s|)) (_ BitVec 32) (bvsub (|output_gate#164| state) #b00000000000000000000000000000001)) ; $sub$output_gate.v:105$30_Y
(define-fun |output_gate#347| ((state |output_gate_s|)) (_ BitVec 32) (ite (= ((_ extract 0 0) (|output_gate#20| state)) #b1) (|output_gate#164| state) (|output_gate#346| state))) ; $procmux$476_Y
(define-fun |output_gate#348| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#102| state) (|output_gate#103| state) (|output_gate#347| state))) ; $procmux$479_Y
(define-fun |output_gate#349| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#150| state) #b00000000000000000000000000000000 (|output_gate#348| state))) ; $0\silence_q[31:0]
(define-fun |output_gate#350| ((state |output_gate_s|)) (_ BitVec 16) (bvsub (|output_gate#151| state) #b0000000000000001)) ; $sub$output_gate.v:135$46_Y
(define-fun |output_gate#351| ((state |output_gate_s|)) (_ BitVec 16) (ite (|output_gate#82| state) (|output_gate#350| state) #b1111010000100011)) ; $ternary$output_gate.v:135$47_Y
(define-fun |output_gate#352| ((state |output_gate_s|)) (_ BitVec 16) (ite (|output_gate#150| state) #b0000000000000000 (|output_gate#351| state))) ; $0\settle_left_q[15:0]
(define-fun |output_gate#353| ((state |output_gate_s|)) (_ BitVec 32) (bvsub (|output_gate#148| state) #b00000000000000000000000000000001)) ; $sub$output_gate.v:115$38_Y
(define-fun |output_gate#354| ((state |output_gate_s|)) (_ BitVec 32) (ite (= ((_ extract 0 0) (|output_gate#140| state)) #b1) (|output_gate#353| state) (|output_gate#148| state))) ; $procmux$462_Y
(define-fun |output_gate#355| ((state |output_gate_s|)) Bool (distinct ((_ extract 8 4) (|output_gate#53| state)) #b00000)) ; $ne$output_gate.v:111$37_Y
(define-fun |output_gate#356| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#355| state) #b00000000111011100110101100101000 (|output_gate#354| state))) ; $procmux$465_Y
(define-fun |output_gate#357| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#150| state) #b00000000000000000000000000000000 (|output_gate#356| state))) ; $0\rest_left_q[31:0]
(define-fun |output_gate#358| ((state |output_gate_s|)) Bool (distinct (|output_gate#148| state) #b00000000000000000000000000000001)) ; $ne$output_gate.v:116$39_Y
(define-fun |output_gate#359| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#140| state)) #b1) (ite (|output_gate#358| state) #b1 #b0) #b0)) ; $procmux$455_Y
(define-fun |output_gate#360| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#355| state) #b1 (|output_gate#359| state))) ; $procmux$458_Y
(define-fun |output_gate#361| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#150| state) #b0 (|output_gate#360| state))) ; $0\resting_q[0:0]
(define-fun |output_gate#362| ((state |output_gate_s|)) (_ BitVec 3) (bvand (concat ((_ extract 1 0) (|output_gate#124| state)) (ite (|output_gate#89| state) #b1 #b0)) (concat (ite (|output_gate#134| state) #b1 #b0) (concat (ite (|output_gate#134| state) #b1 #b0) (ite (|output_gate#134| state) #b1 #b0))))) ; $and$output_gate.v:136$48_Y
(define-fun |output_gate#363| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#150| state) #b000 (|output_gate#362| state))) ; $0\on_later_q[2:0]
(define-fun |output_gate#364| ((state |output_gate_s|)) (_ BitVec 3) (bvand (concat ((_ extract 1 0) (|output_gate#115| state)) (ite (|output_gate#88| state) #b1 #b0)) (concat (ite (|output_gate#134| state) #b1 #b0) (concat (ite (|output_gate#134| state) #b1 #b0) (ite (|output_gate#134| state) #b1 #b0))))) ; $and$output_gate.v:137$49_Y
(define-fun |output_gate#365| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#150| state) #b000 (|output_gate#364| state))) ; $0\moves_later_q[2:0]
(define-fun |output_gate#366| ((state |output_gate_s|)) (_ BitVec 16) (bvsub (|output_gate#101| state) #b0000000000000001)) ; $sub$output_gate.v:143$61_Y
(define-fun |output_gate#367| ((state |output_gate_s|)) Bool (distinct (|output_gate#101| state) #b0000000000000000)) ; $ne$output_gate.v:143$60_Y
(define-fun |output_gate#368| ((state |output_gate_s|)) (_ BitVec 16) (ite (|output_gate#367| state) (|output_gate#366| state) (|output_gate#101| state))) ; $procmux$433_Y
(define-fun |output_gate#369| ((state |output_gate_s|)) (_ BitVec 16) (bvsub (|output_gate#46| state) #b0000000000000001)) ; $sub$output_gate.v:142$59_Y
(define-fun |output_gate#370| ((state |output_gate_s|)) (_ BitVec 16) (ite (|output_gate#81| state) (|output_gate#369| state) (|output_gate#368| state))) ; $procmux$436_Y
(define-fun |output_gate#371| ((state |output_gate_s|)) (_ BitVec 16) (ite (|output_gate#135| state) (|output_gate#370| state) #b0000000000000000)) ; $procmux$439_Y
(define-fun |output_gate#372| ((state |output_gate_s|)) (_ BitVec 16) (ite (|output_gate#150| state) #b0000000000000000 (|output_gate#371| state))) ; $0\focus_left_q[15:0]
(define-fun |output_gate#373| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#102| state) (|output_gate#103| state) (|output_gate#100| state))) ; $0\fed_ticks_q[31:0]
(define-fun |output_gate#374| ((state |output_gate_s|)) Bool (not (or  (|output_gate#150| state) false))) ; $logic_not$output_gate.v:177$67_Y
(define-fun |output_gate#375| ((state |output_gate_s|)) Bool (or  (= ((_ extract 0 0) (|output_gate#99| state)) #b1) false  (|output_gate#102| state) false)) ; $logic_or$output_gate_properties.vh:77$162_Y
(define-fun |output_gate#376| ((state |output_gate_s|)) Bool (and (or  (|output_gate#374| state) false) (or  (|output_gate#375| state) false))) ; $0\fed_q[0:0]
(define-fun |output_gate#377| ((state |output_gate_s|)) Bool (distinct (|output_gate#149| state) #b000000000)) ; $ne$output_gate.v:110$34_Y
(define-fun |output_gate#378| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#56| state) (ite (|output_gate#377| state) #b1 #b0) (|output_gate#97| state))) ; $ternary$output_gate.v:110$35_Y
(define-fun |output_gate#379| ((state |output_gate_s|)) Bool (or  (= ((_ extract 0 0) (|output_gate#378| state)) #b1) false  (|output_gate#156| state) false)) ; $logic_or$output_gate.v:110$36_Y
(define-fun |output_gate#380| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#150| state) #b0 (ite (|output_gate#379| state) #b1 #b0))) ; $0\faulted_q[0:0]
(define-fun |output_gate#381| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#97| state)) #b1) false))) ; $logic_not$output_gate.v:118$40_Y
(define-fun |output_gate#382| ((state |output_gate_s|)) Bool (and (or  (|output_gate#156| state) false) (or  (|output_gate#381| state) false))) ; $logic_and$output_gate.v:118$41_Y
(define-fun |output_gate#383| ((state |output_gate_s|)) (_ BitVec 64) (ite (|output_gate#382| state) (|output_gate#123| state) (|output_gate#96| state))) ; $procmux$443_Y
(define-fun |output_gate#384| ((state |output_gate_s|)) (_ BitVec 64) (ite (|output_gate#150| state) #b0000000000000000000000000000000000000000000000000000000000000000 (|output_gate#383| state))) ; $0\fault_time_q[63:0]
(define-fun |output_gate#385| ((state |output_gate_s|)) (_ BitVec 9) (ite (|output_gate#56| state) (|output_gate#149| state) (|output_gate#95| state))) ; $ternary$output_gate.v:109$32_Y
(define-fun |output_gate#386| ((state |output_gate_s|)) (_ BitVec 9) (bvor (|output_gate#385| state) (|output_gate#53| state))) ; $or$output_gate.v:109$33_Y
(define-fun |output_gate#387| ((state |output_gate_s|)) (_ BitVec 9) (ite (|output_gate#150| state) #b000000000 (|output_gate#386| state))) ; $0\fault_q[8:0]
(define-fun |output_gate#388| ((state |output_gate_s|)) (_ BitVec 32) (bvadd (|output_gate#94| state) #b00000000000000000000000000000001)) ; $add$output_gate.v:119$42_Y
(define-fun |output_gate#389| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#382| state) (|output_gate#388| state) (|output_gate#94| state))) ; $procmux$451_Y
(define-fun |output_gate#390| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#150| state) #b00000000000000000000000000000000 (|output_gate#389| state))) ; $0\fault_count_q[31:0]
(define-fun |output_gate#391| ((state |output_gate_s|)) Bool (bvule (|output_gate#40| state) #b101)) ; $0\exists_1_q[0:0]
(define-fun |output_gate#392| ((state |output_gate_s|)) (_ BitVec 32) (bvadd (|output_gate#80| state) #b00000000000000000000000000000001)) ; $add$output_gate.v:140$57_Y
(define-fun |output_gate#393| ((state |output_gate_s|)) Bool (and (or  (|output_gate#81| state) false) (or  (|output_gate#135| state) false))) ; $logic_and$output_gate.v:140$56_Y
(define-fun |output_gate#394| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#393| state) (|output_gate#392| state) (|output_gate#80| state))) ; $procmux$429_Y
(define-fun |output_gate#395| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#150| state) #b00000000000000000000000000000000 (|output_gate#394| state))) ; $0\emissions_q[31:0]
(define-fun |output_gate#396| ((state |output_gate_s|)) Bool (not (or  (|output_gate#38| state) false))) ; $logic_not$output_gate_properties.vh:76$155_Y
(define-fun |output_gate#397| ((state |output_gate_s|)) Bool (and (or  (|output_gate#374| state) false) (or  (|output_gate#396| state) false))) ; $logic_and$output_gate_properties.vh:76$156_Y
(define-fun |output_gate#398| ((state |output_gate_s|)) Bool (not (or  (|output_gate#90| state) false))) ; $logic_not$output_gate_properties.vh:76$157_Y
(define-fun |output_gate#399| ((state |output_gate_s|)) Bool (and (or  (|output_gate#63| state) false) (or  (|output_gate#398| state) false))) ; $logic_and$output_gate_properties.vh:76$158_Y
(define-fun |output_gate#400| ((state |output_gate_s|)) Bool (or  (= ((_ extract 0 0) (|output_gate#69| state)) #b1) false  (|output_gate#399| state) false)) ; $logic_or$output_gate_properties.vh:76$159_Y
(define-fun |output_gate#401| ((state |output_gate_s|)) Bool (and (or  (|output_gate#397| state) false) (or  (|output_gate#400| state) false))) ; $0\disarmed_q[0:0]
(define-fun |output_gate#402| ((state |output_gate_s|)) Bool (not (or  (|output_gate#156| state) false))) ; $logic_not$output_gate.v:138$50_Y
(define-fun |output_gate#403| ((state |output_gate_s|)) Bool (and (or  (|output_gate#38| state) false) (or  (|output_gate#402| state) false))) ; $logic_and$output_gate.v:138$51_Y
(define-fun |output_gate#404| ((state |output_gate_s|)) Bool (and (or  (|output_gate#134| state) false) (or  (|output_gate#283| state) false))) ; $logic_and$output_gate.v:138$54_Y
(define-fun |output_gate#405| ((state |output_gate_s|)) Bool (or  (|output_gate#403| state) false  (|output_gate#404| state) false)) ; $logic_or$output_gate.v:138$55_Y
(define-fun |output_gate#406| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#150| state) #b0 (ite (|output_gate#405| state) #b1 #b0))) ; $0\live_q[0:0]
(define-fun |output_gate#407| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#137| state) #b000 (|output_gate#40| state))) ; $procmux$484_Y
(define-fun |output_gate#408| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#152| state) #b100 (|output_gate#40| state))) ; $procmux$488_Y
(define-fun |output_gate#409| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#63| state) #b011 (|output_gate#40| state))) ; $procmux$491_Y
(define-fun |output_gate#410| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#137| state) #b010 (|output_gate#40| state))) ; $procmux$494_Y
(define-fun |output_gate#411| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#63| state) #b100 (|output_gate#410| state))) ; $procmux$497_Y
(define-fun |output_gate#412| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#151| state)) #b1) (= ((_ extract 1 1) (|output_gate#151| state)) #b1) (= ((_ extract 2 2) (|output_gate#151| state)) #b1) (= ((_ extract 3 3) (|output_gate#151| state)) #b1) (= ((_ extract 4 4) (|output_gate#151| state)) #b1) (= ((_ extract 5 5) (|output_gate#151| state)) #b1) (= ((_ extract 6 6) (|output_gate#151| state)) #b1) (= ((_ extract 7 7) (|output_gate#151| state)) #b1) (= ((_ extract 8 8) (|output_gate#151| state)) #b1) (= ((_ extract 9 9) (|output_gate#151| state)) #b1) (= ((_ extract 10 10) (|output_gate#151| state)) #b1) (= ((_ extract 11 11) (|output_gate#151| state)) #b1) (= ((_ extract 12 12) (|output_gate#151| state)) #b1) (= ((_ extract 13 13) (|output_gate#151| state)) #b1) (= ((_ extract 14 14) (|output_gate#151| state)) #b1) (= ((_ extract 15 15) (|output_gate#151| state)) #b1)))) ; $eq$output_gate.v:126$45_Y
(define-fun |output_gate#413| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#412| state) #b001 (|output_gate#40| state))) ; $procmux$500_Y
(define-fun |output_gate#414| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#63| state) #b000 (|output_gate#413| state))) ; $procmux$503_Y
(define-fun |output_gate#415| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#38| state) #b101 (|output_gate#40| state))) ; $procmux$506_Y
(define-fun |output_gate#416| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#90| state) (|output_gate#415| state) (ite (|output_gate#82| state) (|output_gate#414| state) (ite (|output_gate#83| state) (|output_gate#411| state) (ite (|output_gate#41| state) (|output_gate#409| state) (ite (|output_gate#85| state) (|output_gate#408| state) (ite (|output_gate#87| state) (|output_gate#407| state) #b000))))))) ; $procmux$486_Y
(define-fun |output_gate#417| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#156| state) #b000 (|output_gate#416| state))) ; $procmux$509_Y
(define-fun |output_gate#418| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#150| state) #b000 (|output_gate#417| state))) ; $0\state_q[2:0]
(define-fun |output_gate#419| ((state |output_gate_s|)) Bool (and (or  (|output_gate#135| state) false) (or  (|output_gate#374| state) false))) ; $0\hv_enable_q[0:0]
(define-fun |output_gate#420| ((state |output_gate_s|)) Bool (or  (|output_gate#81| state) false  (|output_gate#367| state) false)) ; $logic_or$output_gate.v:180$81_Y
(define-fun |output_gate#421| ((state |output_gate_s|)) Bool (and (or  (|output_gate#419| state) false) (or  (|output_gate#420| state) false))) ; $0\focus_q[0:0]
(define-fun |output_gate#422| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#23| state)) #b1) #b0 (ite (|output_gate#421| state) #b1 #b0))) ; $auto$rtlil.cc:3381:Mux$1343
(define-fun |output_gate#423| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#19| state)) #b1) (= ((_ extract 1 1) (|output_gate#19| state)) #b1) (= ((_ extract 2 2) (|output_gate#19| state)) #b1) (= ((_ extract 3 3) (|output_gate#19| state)) #b1) (= ((_ extract 4 4) (|output_gate#19| state)) #b1) (= ((_ extract 5 5) (|output_gate#19| state)) #b1) (= ((_ extract 6 6) (|output_gate#19| state)) #b1) (= ((_ extract 7 7) (|output_gate#19| state)) #b1) (= ((_ extract 8 8) (|output_gate#19| state)) #b1) (= ((_ extract 9 9) (|output_gate#19| state)) #b1) (= ((_ extract 10 10) (|output_gate#19| state)) #b1)))) ; $eq$output_gate.v:145$63_Y
(define-fun |output_gate#424| ((state |output_gate_s|)) (_ BitVec 1) (bvxor (|output_gate#30| state) (ite (|output_gate#423| state) #b1 #b0))) ; $xor$output_gate.v:179$76_Y
(define-fun |output_gate#425| ((state |output_gate_s|)) Bool (and (or  (|output_gate#419| state) false) (or  (= ((_ extract 0 0) (|output_gate#424| state)) #b1) false))) ; $0\hv_alive_q[0:0]
(define-fun |output_gate#426| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#23| state)) #b1) #b0 (ite (|output_gate#425| state) #b1 #b0))) ; $auto$rtlil.cc:3381:Mux$1341
(define-fun |output_gate#427| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#23| state)) #b1) #b0 (ite (|output_gate#419| state) #b1 #b0))) ; $auto$rtlil.cc:3381:Mux$1345
(define-fun |output_gate#428| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 0 0) (|output_gate#22| state)) #b1) false) (or  (|output_gate#47| state) false))) ; $logic_and$output_gate_properties.vh:75$145_Y
(define-fun |output_gate#429| ((state |output_gate_s|)) Bool (and (or  (|output_gate#428| state) false) (or  (|output_gate#49| state) false))) ; $logic_and$output_gate_properties.vh:75$146_Y
(define-fun |output_gate#430| ((state |output_gate_s|)) Bool (and (or  (|output_gate#429| state) false) (or  (|output_gate#21| state) false))) ; $logic_and$output_gate_properties.vh:75$147_Y
(define-fun |output_gate#431| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 1 1) (|output_gate#51| state)) #b1) (= ((_ extract 2 2) (|output_gate#51| state)) #b1) (= ((_ extract 3 3) (|output_gate#51| state)) #b1) (= ((_ extract 4 4) (|output_gate#51| state)) #b1) (= ((_ extract 5 5) (|output_gate#51| state)) #b1)))) ; $eq$output_gate_properties.vh:75$148_Y
(define-fun |output_gate#432| ((state |output_gate_s|)) Bool (and (or  (|output_gate#430| state) false) (or  (|output_gate#431| state) false))) ; $logic_and$output_gate_properties.vh:75$149_Y
(define-fun |output_gate#433| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#51| state)) #b1) false))) ; $logic_not$output_gate_properties.vh:75$150_Y
(define-fun |output_gate#434| ((state |output_gate_s|)) Bool (and (or  (|output_gate#432| state) false) (or  (|output_gate#433| state) false))) ; $logic_and$output_gate_properties.vh:75$151_Y
(define-fun |output_gate#435| ((state |output_gate_s|)) Bool (or  (|output_gate#38| state) false  (|output_gate#434| state) false)) ; $logic_or$output_gate_properties.vh:75$152_Y
(define-fun |output_gate#436| ((state |output_gate_s|)) Bool (and (or  (|output_gate#374| state) false) (or  (|output_gate#435| state) false))) ; $0\allowed_q[0:0]
(define-fun |output_gate#437| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 1 1) (|output_gate#164| state)) #b1) (= ((_ extract 2 2) (|output_gate#164| state)) #b1) (= ((_ extract 3 3) (|output_gate#164| state)) #b1) (= ((_ extract 4 4) (|output_gate#164| state)) #b1) (= ((_ extract 5 5) (|output_gate#164| state)) #b1) (= ((_ extract 6 6) (|output_gate#164| state)) #b1) (= ((_ extract 7 7) (|output_gate#164| state)) #b1) (= ((_ extract 8 8) (|output_gate#164| state)) #b1) (= ((_ extract 9 9) (|output_gate#164| state)) #b1) (= ((_ extract 10 10) (|output_gate#164| state)) #b1) (= ((_ extract 11 11) (|output_gate#164| state)) #b1) (= ((_ extract 12 12) (|output_gate#164| state)) #b1) (= ((_ extract 13 13) (|output_gate#164| state)) #b1) (= ((_ extract 14 14) (|output_gate#164| state)) #b1) (= ((_ extract 15 15) (|output_gate#164| state)) #b1) (= ((_ extract 16 16) (|output_gate#164| state)) #b1) (= ((_ extract 17 17) (|output_gate#164| state)) #b1) (= ((_ extract 18 18) (|output_gate#164| state)) #b1) (= ((_ extract 19 19) (|output_gate#164| state)) #b1) (= ((_ extract 20 20) (|output_gate#164| state)) #b1) (= ((_ extract 21 21) (|output_gate#164| state)) #b1) (= ((_ extract 22 22) (|output_gate#164| state)) #b1) (= ((_ extract 23 23) (|output_gate#164| state)) #b1) (= ((_ extract 24 24) (|output_gate#164| state)) #b1) (= ((_ extract 25 25) (|output_gate#164| state)) #b1) (= ((_ extract 26 26) (|output_gate#164| state)) #b1) (= ((_ extract 27 27) (|output_gate#164| state)) #b1) (= ((_ extract 28 28) (|output_gate#164| state)) #b1) (= ((_ extract 29 29) (|output_gate#164| state)) #b1) (= ((_ extract 30 30) (|output_gate#164| state)) #b1) (= ((_ extract 31 31) (|output_gate#164| state)) #b1)))) ; $eq$output_gate.v:106$31_Y
(define-fun |output_gate#438| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#20| state)) #b1) #b1 (ite (|output_gate#437| state) #b1 #b0))) ; $procmux$469_Y
(define-fun |output_gate#439| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#102| state) #b0 (|output_gate#438| state))) ; $procmux$472_Y
(define-fun |output_gate#440| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#150| state) #b1 (|output_gate#439| state))) ; $0\silent_q[0:0]
(define-fun |output_gate#441| ((state |output_gate_s|)) (_ BitVec 11) (bvsub (|output_gate#19| state) #b00000000001)) ; $sub$output_gate.v:146$64_Y
(define-fun |output_gate#442| ((state |output_gate_s|)) (_ BitVec 11) (ite (|output_gate#423| state) #b11111001111 (|output_gate#441| state))) ; $procmux$410_Y
(define-fun |output_gate#443| ((state |output_gate_s|)) (_ BitVec 11) (ite (|output_gate#135| state) (|output_gate#442| state) #b00000000000)) ; $procmux$413_Y
(define-fun |output_gate#444| ((state |output_gate_s|)) (_ BitVec 11) (ite (|output_gate#150| state) #b00000000000 (|output_gate#443| state))) ; $0\alive_left_q[10:0]
(define-fun |output_gate#445| ((state |output_gate_s|)) (_ BitVec 16) (bvadd (|output_gate#18| state) #b0000000000000001)) ; $add$output_gate_properties.vh:15$113_Y
(define-fun |output_gate#446| ((state |output_gate_s|)) (_ BitVec 16) (ite (|output_gate#289| state) #b1111010000100100 (|output_gate#445| state))) ; $0\longer$func$output_gate_properties.vh:60$1.$result[15:0]$107
(define-fun |output_gate#447| ((state |output_gate_s|)) Bool (not (or  (|output_gate#134| state) false))) ; $logic_not$output_gate_properties.vh:60$115_Y
(define-fun |output_gate#448| ((state |output_gate_s|)) Bool (or  (|output_gate#150| state) false  (|output_gate#447| state) false)) ; $logic_or$output_gate_properties.vh:60$116_Y
(define-fun |output_gate#449| ((state |output_gate_s|)) Bool (not (or  (|output_gate#89| state) false))) ; $logic_not$output_gate_properties.vh:60$117_Y
(define-fun |output_gate#450| ((state |output_gate_s|)) Bool (or  (|output_gate#448| state) false  (|output_gate#449| state) false)) ; $logic_or$output_gate_properties.vh:60$118_Y
(define-fun |output_gate#451| ((state |output_gate_s|)) (_ BitVec 16) (ite (|output_gate#450| state) #b0000000000000000 (|output_gate#446| state))) ; $0\age_q[15:0]
(define-fun |output_gate#452| ((state |output_gate_s|)) (_ BitVec 16) (ite (|output_gate#448| state) #b0000000000000000 (|output_gate#16| state))) ; $0\age_4_q[15:0]
(define-fun |output_gate#453| ((state |output_gate_s|)) (_ BitVec 16) (ite (|output_gate#448| state) #b0000000000000000 (|output_gate#15| state))) ; $0\age_3_q[15:0]
(define-fun |output_gate#454| ((state |output_gate_s|)) (_ BitVec 16) (ite (|output_gate#448| state) #b0000000000000000 (|output_gate#14| state))) ; $0\age_2_q[15:0]
(define-fun |output_gate#455| ((state |output_gate_s|)) (_ BitVec 16) (ite (|output_gate#448| state) #b0000000000000000 (|output_gate#18| state))) ; $0\age_1_q[15:0]
(define-fun |output_gate#456| ((state |output_gate_s|)) (_ BitVec 32) (bvadd (|output_gate#10| state) #b00000000000000000000000000000001)) ; $add$output_gate_properties.vh:80$174_Y
(define-fun |output_gate#457| ((state |output_gate_s|)) Bool (= (|output_gate#10| state) #b00000000111011100110101100101000)) ; $eq$output_gate_properties.vh:80$173_Y
(define-fun |output_gate#458| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#457| state) #b00000000111011100110101100101000 (|output_gate#456| state))) ; $ternary$output_gate_properties.vh:80$175_Y
(define-fun |output_gate#459| ((state |output_gate_s|)) Bool (distinct ((_ extract 5 1) (|output_gate#51| state)) #b00000)) ; $ne$output_gate_properties.vh:80$169_Y
(define-fun |output_gate#460| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 0 0) (|output_gate#52| state)) #b1) false) (or  (|output_gate#459| state) false))) ; $logic_and$output_gate_properties.vh:80$170_Y
(define-fun |output_gate#461| ((state |output_gate_s|)) Bool (or  false (= ((_ extract 2 2) (|output_gate#51| state)) #b1) (= ((_ extract 3 3) (|output_gate#51| state)) #b1) false false)) ; $ne$output_gate_properties.vh:80$171_Y
(define-fun |output_gate#462| ((state |output_gate_s|)) Bool (or  (|output_gate#460| state) false  (|output_gate#461| state) false)) ; $logic_or$output_gate_properties.vh:80$172_Y
(define-fun |output_gate#463| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#462| state) #b00000000000000000000000000000000 (|output_gate#458| state))) ; $ternary$output_gate_properties.vh:80$176_Y
(define-fun |output_gate#464| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#150| state) #b00000000111011100110101100101000 (|output_gate#463| state))) ; $0\since_limit_q[31:0]
(define-fun |output_gate#465| ((state |output_gate_s|)) (_ BitVec 32) (bvand (|output_gate#73| state) (|output_gate#54| state))) ; $and$output_gate.v:177$69_Y
(define-fun |output_gate#466| ((state |output_gate_s|)) Bool (and (or  (|output_gate#135| state) false) (or  (= ((_ extract 2 2) (|output_gate#115| state)) #b1) false))) ; $logic_and$output_gate.v:177$66_Y
(define-fun |output_gate#467| ((state |output_gate_s|)) Bool (and (or  (|output_gate#466| state) false) (or  (|output_gate#374| state) false))) ; $logic_and$output_gate.v:177$68_Y
(define-fun |output_gate#468| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#467| state) (|output_gate#465| state) #b00000000000000000000000000000000)) ; $0\channel_q[31:0]
(define-fun |output_gate#469| ((state |output_gate_s|)) (_ BitVec 32) (ite (= ((_ extract 0 0) (|output_gate#23| state)) #b1) #b00000000000000000000000000000000 (|output_gate#468| state))) ; $auto$rtlil.cc:3381:Mux$1347
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
  (|output_gate_a 49| state)
  (|output_gate_a 50| state)
  (|output_gate_a 51| state)
))
(define-fun |output_gate_u| ((state |output_gate_s|)) Bool (and
  (|output_gate_u 0| state)
  (|output_gate_u 1| state)
  (|output_gate_u 2| state)
  (|output_gate_u 3| state)
))
(define-fun |output_gate_i| ((state |output_gate_s|)) Bool 
  (= (= ((_ extract 0 0) (|output_gate#8| state)) #b1) false) ; started_q
)
(define-fun |output_gate_h| ((state |output_gate_s|)) Bool true)
(define-fun |output_gate_t| ((state |output_gate_s|) (next_state |output_gate_s|)) Bool (and
  (= (|output_gate#337| state) (|output_gate#177| next_state)) ; $procdff$1031 \up_q
  (= (|output_gate#341| state) (|output_gate#176| next_state)) ; $procdff$1035 \unfed_q
  (= (|output_gate#345| state) (|output_gate#175| next_state)) ; $procdff$994 \underruns_q
  (= ((_ extract 0 0) (|output_gate#51| state)) (|output_gate#170| next_state)) ; $procdff$1042 \underrun_1_q
  (= (|output_gate#349| state) (|output_gate#164| next_state)) ; $procdff$987 \silence_q
  (= (|output_gate#20| state) (|output_gate#160| next_state)) ; $procdff$1019 \silent_1_q
  (= (|output_gate#352| state) (|output_gate#151| next_state)) ; $procdff$996 \settle_left_q
  (= (|output_gate#357| state) (|output_gate#148| next_state)) ; $procdff$991 \rest_left_q
  (= (|output_gate#140| state) (|output_gate#144| next_state)) ; $procdff$1025 \resting_1_q
  (= (|output_gate#361| state) (|output_gate#140| next_state)) ; $procdff$992 \resting_q
  (= (ite (|output_gate#47| state) #b1 #b0) (|output_gate#136| next_state)) ; $procdff$1017 \permit_1_q
  (= (|output_gate#363| state) (|output_gate#124| next_state)) ; $procdff$997 \on_later_q
  (= (|output_gate#123| state) (|output_gate#122| next_state)) ; $procdff$1047 \now_1_q
  (= (|output_gate#365| state) (|output_gate#115| next_state)) ; $procdff$998 \moves_later_q
  (= (|output_gate#54| state) (|output_gate#113| next_state)) ; $procdff$1021 \mask_1_q
  (= (|output_gate#27| state) (|output_gate#105| next_state)) ; $procdff$1024 \hv_1_q
  (= (|output_gate#372| state) (|output_gate#101| next_state)) ; $procdff$1000 \focus_left_q
  (= (|output_gate#373| state) (|output_gate#100| next_state)) ; $procdff$1034 \fed_ticks_q
  (= (ite (|output_gate#376| state) #b1 #b0) (|output_gate#99| next_state)) ; $procdff$1036 \fed_q
  (= ((_ extract 8 4) (|output_gate#95| state)) (|output_gate#98| next_state)) ; $procdff$1023 \faults_1_q
  (= (|output_gate#380| state) (|output_gate#97| next_state)) ; $procdff$990 \faulted_q
  (= (|output_gate#384| state) (|output_gate#96| next_state)) ; $procdff$995 \fault_time_q
  (= (|output_gate#387| state) (|output_gate#95| next_state)) ; $procdff$989 \fault_q
  (= (|output_gate#390| state) (|output_gate#94| next_state)) ; $procdff$993 \fault_count_q
  (= (|output_gate#94| state) (|output_gate#93| next_state)) ; $procdff$1046 \fault_count_1_q
  (= (ite (|output_gate#391| state) #b1 #b0) (|output_gate#92| next_state)) ; $procdff$1020 \exists_1_q
  (= (|output_gate#395| state) (|output_gate#80| next_state)) ; $procdff$1001 \emissions_q
  (= (concat #b00 (concat ((_ extract 3 2) (|output_gate#51| state)) #b0)) (|output_gate#74| next_state)) ; $procdff$1038 \edges_1_q
  (= (|output_gate#73| state) (|output_gate#72| next_state)) ; $procdff$1045 \drive_1_q
  (= (ite (|output_gate#401| state) #b1 #b0) (|output_gate#69| next_state)) ; $procdff$1033 \disarmed_q
  (= (ite (|output_gate#63| state) #b1 #b0) (|output_gate#62| next_state)) ; $procdff$1040 \disarm_1_q
  (= (ite (|output_gate#49| state) #b1 #b0) (|output_gate#58| next_state)) ; $procdff$1018 \cool_1_q
  (= (ite (|output_gate#56| state) #b1 #b0) (|output_gate#55| next_state)) ; $procdff$1041 \clear_1_q
  (= (|output_gate#406| state) (|output_gate#52| next_state)) ; $procdff$999 \live_q
  (= ((_ extract 5 1) (|output_gate#51| state)) (|output_gate#42| next_state)) ; $procdff$1022 \limits_1_q
  (= (|output_gate#418| state) (|output_gate#40| next_state)) ; $procdff$986 \state_q
  (= (ite (|output_gate#38| state) #b1 #b0) (|output_gate#37| next_state)) ; $procdff$1039 \arm_1_q
  (= (|output_gate#422| state) (|output_gate#32| next_state)) ; $procdff$1011 \_witness_.anyinit_procdff_1011
  (= (|output_gate#426| state) (|output_gate#29| next_state)) ; $procdff$1014 \_witness_.anyinit_procdff_1014
  (= (|output_gate#427| state) (|output_gate#26| next_state)) ; $procdff$1008 \_witness_.anyinit_procdff_1008
  (= (ite (|output_gate#436| state) #b1 #b0) (|output_gate#22| next_state)) ; $procdff$1032 \allowed_q
  (= (|output_gate#440| state) (|output_gate#20| next_state)) ; $procdff$988 \silent_q
  (= (|output_gate#444| state) (|output_gate#19| next_state)) ; $procdff$1002 \alive_left_q
  (= (|output_gate#451| state) (|output_gate#18| next_state)) ; $procdff$1026 \age_q
  (= (|output_gate#452| state) (|output_gate#17| next_state)) ; $procdff$1030 \age_4_q
  (= (|output_gate#453| state) (|output_gate#16| next_state)) ; $procdff$1029 \age_3_q
  (= (|output_gate#454| state) (|output_gate#15| next_state)) ; $procdff$1028 \age_2_q
  (= (|output_gate#455| state) (|output_gate#14| next_state)) ; $procdff$1027 \age_1_q
  (= (|output_gate#464| state) (|output_gate#10| next_state)) ; $procdff$1037 \since_limit_q
  (= #b1 (|output_gate#8| next_state)) ; $procdff$1015 \started_q
  (= (ite (|output_gate#150| state) #b1 #b0) (|output_gate#6| next_state)) ; $procdff$1016 \rst_1_q
  (= (concat #b0000000 (|output_gate#95| state)) (|output_gate#2| next_state)) ; $procdff$1044 \all_faults_1_q
  (= (ite (|output_gate#156| state) #b1 #b0) (|output_gate#1| next_state)) ; $procdff$1043 \shut_1_q
  (= (|output_gate#469| state) (|output_gate#0| next_state)) ; $procdff$1005 \_witness_.anyinit_procdff_1005
)) ; end of module output_gate
