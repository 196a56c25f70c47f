; of 5806c35ecd0a8ac13ad7d8c236de63193acfc2c2e657db238d9aeb6e19f5ca93, by python -m tests.rtl.proofs
(declare-sort |output_gate_s| 0)
(declare-fun |output_gate_is| (|output_gate_s|) Bool)
(declare-fun |output_gate#0| (|output_gate_s|) (_ BitVec 32)) ; \_witness_.anyinit_procdff_720
(define-fun |output_gate_n _witness_.anyinit_procdff_720| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#0| state))
(declare-fun |output_gate#1| (|output_gate_s|) (_ BitVec 17)) ; \age_1_q
(define-fun |output_gate_n age_1_q| ((state |output_gate_s|)) (_ BitVec 17) (|output_gate#1| state))
(declare-fun |output_gate#2| (|output_gate_s|) (_ BitVec 17)) ; \age_2_q
(define-fun |output_gate_n age_2_q| ((state |output_gate_s|)) (_ BitVec 17) (|output_gate#2| state))
(declare-fun |output_gate#3| (|output_gate_s|) (_ BitVec 17)) ; \age_3_q
(define-fun |output_gate_n age_3_q| ((state |output_gate_s|)) (_ BitVec 17) (|output_gate#3| state))
(declare-fun |output_gate#4| (|output_gate_s|) (_ BitVec 17)) ; \age_4_q
(define-fun |output_gate_n age_4_q| ((state |output_gate_s|)) (_ BitVec 17) (|output_gate#4| state))
(declare-fun |output_gate#5| (|output_gate_s|) (_ BitVec 17)) ; \age_q
(define-fun |output_gate_n age_q| ((state |output_gate_s|)) (_ BitVec 17) (|output_gate#5| state))
(declare-fun |output_gate#6| (|output_gate_s|) (_ BitVec 32)) ; \alive_left_q
(define-fun |output_gate_n alive_left_q| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#6| state))
(declare-fun |output_gate#7| (|output_gate_s|) (_ BitVec 1)) ; \silent_q
(define-fun |output_gate#8| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#7| state)) #b1) false))) ; \alive_o
(define-fun |output_gate_n alive_o| ((state |output_gate_s|)) Bool (|output_gate#8| state))
(declare-fun |output_gate#9| (|output_gate_s|) Bool) ; \arm_i
(define-fun |output_gate_n arm_i| ((state |output_gate_s|)) Bool (|output_gate#9| state))
(declare-fun |output_gate#10| (|output_gate_s|) (_ BitVec 3)) ; \state_q
(define-fun |output_gate#11| ((state |output_gate_s|)) Bool (= (|output_gate#10| state) #b010)) ; \armed_o
(define-fun |output_gate_n armed_o| ((state |output_gate_s|)) Bool (|output_gate#11| state))
(declare-fun |output_gate#12| (|output_gate_s|) (_ BitVec 5)) ; \limits_1_q
(define-fun |output_gate#13| ((state |output_gate_s|)) Bool (distinct (|output_gate#12| state) #b00000)) ; $ne$output_gate_properties.vh:51$167_Y
(define-fun |output_gate#14| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#13| state) #b1 #b0)) ; $procmux$679_Y
(declare-fun |output_gate#15| (|output_gate_s|) (_ BitVec 1)) ; \started_q
(define-fun |output_gate#16| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#15| state)) #b1) (|output_gate#14| state) #b0)) ; \beyond_is_off_EN
(define-fun |output_gate_n beyond_is_off_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#16| state)) #b1))
(declare-fun |output_gate#17| (|output_gate_s|) (_ BitVec 16)) ; \bit_ticks_i
(define-fun |output_gate_n bit_ticks_i| ((state |output_gate_s|)) (_ BitVec 16) (|output_gate#17| state))
(define-fun |output_gate#18| ((state |output_gate_s|)) Bool (= (|output_gate#10| state) #b101)) ; \settling
(define-fun |output_gate#19| ((state |output_gate_s|)) Bool (= (|output_gate#10| state) #b001)) ; \ramp_up_o
(define-fun |output_gate#20| ((state |output_gate_s|)) Bool (or  (|output_gate#19| state) false  (|output_gate#11| state) false)) ; $logic_or$output_gate.v:78$10_Y
(define-fun |output_gate#21| ((state |output_gate_s|)) Bool (= (|output_gate#10| state) #b011)) ; \stopping_o
(define-fun |output_gate#22| ((state |output_gate_s|)) Bool (or  (|output_gate#20| state) false  (|output_gate#21| state) false)) ; $logic_or$output_gate.v:78$12_Y
(define-fun |output_gate#23| ((state |output_gate_s|)) Bool (= (|output_gate#10| state) #b100)) ; \ramp_down_o
(define-fun |output_gate#24| ((state |output_gate_s|)) Bool (or  (|output_gate#22| state) false  (|output_gate#23| state) false)) ; \moves
(define-fun |output_gate#25| ((state |output_gate_s|)) Bool (or  (|output_gate#18| state) false  (|output_gate#24| state) false)) ; \on
(declare-fun |output_gate#26| (|output_gate_s|) (_ BitVec 3)) ; \on_later_q
(define-fun |output_gate#27| ((state |output_gate_s|)) Bool (distinct (|output_gate#26| state) #b000)) ; $ne$output_gate.v:81$18_Y
(define-fun |output_gate#28| ((state |output_gate_s|)) Bool (or  (|output_gate#25| state) false  (|output_gate#27| state) false)) ; $logic_or$output_gate.v:81$19_Y
(declare-fun |output_gate#29| (|output_gate_s|) (_ BitVec 1)) ; \_witness_.anyinit_procdff_723
(declare-fun |output_gate#30| (|output_gate_s|) (_ BitVec 1)) ; \clock_lost_i
(define-fun |output_gate#31| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#30| state)) #b1) #b0 (|output_gate#29| state))) ; \hv_enable_q
(define-fun |output_gate#32| ((state |output_gate_s|)) Bool (or  (|output_gate#28| state) false  (= ((_ extract 0 0) (|output_gate#31| state)) #b1) false)) ; \live
(declare-fun |output_gate#33| (|output_gate_s|) Bool) ; \run_permit_i
(define-fun |output_gate#34| ((state |output_gate_s|)) Bool (not (or  (|output_gate#33| state) false))) ; $logic_not$output_gate.v:83$21_Y
(define-fun |output_gate#35| ((state |output_gate_s|)) Bool (and (or  (|output_gate#32| state) false) (or  (|output_gate#34| state) false))) ; \cause [0]
(define-fun |output_gate#36| ((state |output_gate_s|)) Bool (and (or  (|output_gate#32| state) false) (or  (= ((_ extract 0 0) (|output_gate#7| state)) #b1) false))) ; \cause [1]
(declare-fun |output_gate#37| (|output_gate_s|) Bool) ; \temperature_good_i
(define-fun |output_gate#38| ((state |output_gate_s|)) Bool (not (or  (|output_gate#37| state) false))) ; $logic_not$output_gate.v:85$24_Y
(define-fun |output_gate#39| ((state |output_gate_s|)) Bool (and (or  (|output_gate#32| state) false) (or  (|output_gate#38| state) false))) ; \cause [2]
(declare-fun |output_gate#40| (|output_gate_s|) Bool) ; \underrun_i
(define-fun |output_gate#41| ((state |output_gate_s|)) Bool (and (or  (|output_gate#32| state) false) (or  (|output_gate#40| state) false))) ; \cause [3]
(declare-fun |output_gate#42| (|output_gate_s|) (_ BitVec 5)) ; \limits_i
(define-fun |output_gate#43| ((state |output_gate_s|)) (_ BitVec 5) (bvand (|output_gate#42| state) (concat (ite (|output_gate#32| state) #b1 #b0) (concat (ite (|output_gate#32| state) #b1 #b0) (concat (ite (|output_gate#32| state) #b1 #b0) (concat (ite (|output_gate#32| state) #b1 #b0) (ite (|output_gate#32| state) #b1 #b0))))))) ; \cause [8:4]
(define-fun |output_gate_n cause| ((state |output_gate_s|)) (_ BitVec 9) (concat (|output_gate#43| state) (concat (ite (|output_gate#41| state) #b1 #b0) (concat (ite (|output_gate#39| state) #b1 #b0) (concat (ite (|output_gate#36| state) #b1 #b0) (ite (|output_gate#35| state) #b1 #b0))))))
(declare-fun |output_gate#44| (|output_gate_s|) (_ BitVec 32)) ; \channel_mask_i
(define-fun |output_gate_n channel_mask_i| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#44| state))
(define-fun |output_gate#45| ((state |output_gate_s|)) (_ BitVec 32) (ite (= ((_ extract 0 0) (|output_gate#30| state)) #b1) #b00000000000000000000000000000000 (|output_gate#0| state))) ; \channel_q
(define-fun |output_gate_n channel_o| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#45| state))
(define-fun |output_gate_n channel_q| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#45| state))
(declare-fun |output_gate#46| (|output_gate_s|) Bool) ; \clear_i
(define-fun |output_gate_n clear_i| ((state |output_gate_s|)) Bool (|output_gate#46| state))
(declare-fun |output_gate#47| (|output_gate_s|) Bool) ; \clk_i
(define-fun |output_gate_n clk_i| ((state |output_gate_s|)) Bool (|output_gate#47| state))
(define-fun |output_gate_n clock_lost_i| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#30| state)) #b1))
(declare-fun |output_gate#48| (|output_gate_s|) (_ BitVec 1)) ; \cool_1_q
(define-fun |output_gate_n cool_1_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#48| state)) #b1))
(declare-fun |output_gate#49| (|output_gate_s|) Bool) ; \disarm_i
(define-fun |output_gate_n disarm_i| ((state |output_gate_s|)) Bool (|output_gate#49| state))
(declare-fun |output_gate#50| (|output_gate_s|) (_ BitVec 32)) ; \drive_i
(define-fun |output_gate_n drive_i| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#50| state))
(declare-fun |output_gate#51| (|output_gate_s|) (_ BitVec 32)) ; \emissions_q
(define-fun |output_gate_n emissions_o| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#51| state))
(define-fun |output_gate_n emissions_q| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#51| state))
(declare-fun |output_gate#52| (|output_gate_s|) Bool) ; \ended_i
(define-fun |output_gate_n ended_i| ((state |output_gate_s|)) Bool (|output_gate#52| state))
(define-fun |output_gate#53| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#10| state)) #b1) (= ((_ extract 1 1) (|output_gate#10| state)) #b1) (= ((_ extract 2 2) (|output_gate#10| state)) #b1)))) ; \off_o
(define-fun |output_gate#54| ((state |output_gate_s|)) Bool (or  (|output_gate#25| state) false  (|output_gate#53| state) false)) ; \exists
(define-fun |output_gate_n exists| ((state |output_gate_s|)) Bool (|output_gate#54| state))
(declare-fun |output_gate#55| (|output_gate_s|) (_ BitVec 1)) ; \exists_1_q
(define-fun |output_gate_n exists_1_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#55| state)) #b1))
(declare-fun |output_gate#56| (|output_gate_s|) (_ BitVec 32)) ; \fault_count_q
(define-fun |output_gate_n fault_count_o| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#56| state))
(define-fun |output_gate_n fault_count_q| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#56| state))
(declare-fun |output_gate#57| (|output_gate_s|) (_ BitVec 9)) ; \fault_q
(define-fun |output_gate_n fault_o| ((state |output_gate_s|)) (_ BitVec 16) (concat #b0000000 (|output_gate#57| state)))
(define-fun |output_gate_n fault_q| ((state |output_gate_s|)) (_ BitVec 9) (|output_gate#57| state))
(declare-fun |output_gate#58| (|output_gate_s|) (_ BitVec 64)) ; \fault_time_q
(define-fun |output_gate_n fault_time_o| ((state |output_gate_s|)) (_ BitVec 64) (|output_gate#58| state))
(define-fun |output_gate_n fault_time_q| ((state |output_gate_s|)) (_ BitVec 64) (|output_gate#58| state))
(declare-fun |output_gate#59| (|output_gate_s|) (_ BitVec 5)) ; \faults_1_q
(define-fun |output_gate_n faults_1_q| ((state |output_gate_s|)) (_ BitVec 5) (|output_gate#59| state))
(declare-fun |output_gate#60| (|output_gate_s|) (_ BitVec 16)) ; \focus_left_q
(define-fun |output_gate_n focus_left_q| ((state |output_gate_s|)) (_ BitVec 16) (|output_gate#60| state))
(declare-fun |output_gate#61| (|output_gate_s|) (_ BitVec 1)) ; \_witness_.anyinit_procdff_726
(define-fun |output_gate#62| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#30| state)) #b1) #b0 (|output_gate#61| state))) ; \focus_q
(define-fun |output_gate_n focus_o| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#62| state)) #b1))
(define-fun |output_gate_n focus_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#62| state)) #b1))
(declare-fun |output_gate#63| (|output_gate_s|) Bool) ; \heartbeat_i
(define-fun |output_gate_n heartbeat_i| ((state |output_gate_s|)) Bool (|output_gate#63| state))
(declare-fun |output_gate#64| (|output_gate_s|) (_ BitVec 32)) ; \heartbeat_ticks_i
(define-fun |output_gate_n heartbeat_ticks_i| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#64| state))
(define-fun |output_gate#65| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#48| state)) #b1) #b0 #b1)) ; $procmux$660_Y
(declare-fun |output_gate#66| (|output_gate_s|) (_ BitVec 1)) ; \hv_1_q
(declare-fun |output_gate#67| (|output_gate_s|) (_ BitVec 1)) ; \rst_1_q
(define-fun |output_gate#68| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#67| state)) #b1) false))) ; $logic_not$output_gate_properties.vh:55$175_Y
(define-fun |output_gate#69| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 0 0) (|output_gate#66| state)) #b1) false) (or  (|output_gate#68| state) false))) ; $logic_and$output_gate_properties.vh:55$176_Y
(define-fun |output_gate#70| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#69| state) (|output_gate#65| state) #b0)) ; $procmux$662_Y
(define-fun |output_gate#71| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#15| state)) #b1) (|output_gate#70| state) #b0)) ; \heat_is_kept_EN
(define-fun |output_gate_n heat_is_kept_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#71| state)) #b1))
(define-fun |output_gate_n host_silent| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#7| state)) #b1))
(define-fun |output_gate#72| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#15| state)) #b1) (|output_gate#65| state) #b0)) ; \hot_is_off_EN
(define-fun |output_gate_n hot_is_off_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#72| state)) #b1))
(define-fun |output_gate_n hv_1_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#66| state)) #b1))
(declare-fun |output_gate#73| (|output_gate_s|) (_ BitVec 1)) ; \_witness_.anyinit_procdff_729
(define-fun |output_gate#74| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#30| state)) #b1) #b0 (|output_gate#73| state))) ; \hv_alive_q
(define-fun |output_gate_n hv_alive_o| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#74| state)) #b1))
(define-fun |output_gate_n hv_alive_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#74| state)) #b1))
(define-fun |output_gate_n hv_enable_o| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#31| state)) #b1))
(define-fun |output_gate_n hv_enable_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#31| state)) #b1))
(define-fun |output_gate_n limits_1_q| ((state |output_gate_s|)) (_ BitVec 5) (|output_gate#12| state))
(define-fun |output_gate#75| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#69| state) #b1 #b0)) ; $procmux$648_Y
(define-fun |output_gate#76| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#15| state)) #b1) (|output_gate#75| state) #b0)) ; \limits_are_kept_EN
(define-fun |output_gate_n limits_are_kept_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#76| state)) #b1))
(define-fun |output_gate_n limits_i| ((state |output_gate_s|)) (_ BitVec 5) (|output_gate#42| state))
(define-fun |output_gate_n live| ((state |output_gate_s|)) Bool (|output_gate#32| state))
(define-fun |output_gate_n _witness_.anyinit_procdff_723| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#29| state)) #b1))
(define-fun |output_gate_n _witness_.anyinit_procdff_726| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#61| state)) #b1))
(define-fun |output_gate_n _witness_.anyinit_procdff_729| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#73| state)) #b1))
(declare-fun |output_gate#77| (|output_gate_s|) (_ BitVec 32)) ; \mask_1_q
(define-fun |output_gate_n mask_1_q| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#77| state))
(define-fun |output_gate#78| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#15| state)) #b1) #b1 #b0)) ; \mask_is_kept_EN
(define-fun |output_gate_n mask_is_kept_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#78| state)) #b1))
(define-fun |output_gate_n moves| ((state |output_gate_s|)) Bool (|output_gate#24| state))
(declare-fun |output_gate#79| (|output_gate_s|) (_ BitVec 3)) ; \moves_later_q
(define-fun |output_gate_n moves_later_q| ((state |output_gate_s|)) (_ BitVec 3) (|output_gate#79| state))
(define-fun |output_gate#80| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#24| state) #b1 #b0)) ; $procmux$607_Y
(define-fun |output_gate#81| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#30| state)) #b1) #b0 (|output_gate#80| state))) ; $procmux$609_Y
(define-fun |output_gate#82| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#15| state)) #b1) (|output_gate#81| state) #b0)) ; \moves_once_settled_EN
(define-fun |output_gate_n moves_once_settled_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#82| state)) #b1))
(define-fun |output_gate_n no_channel_alone_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#78| state)) #b1))
(define-fun |output_gate#83| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#30| state)) #b1) #b1 #b0)) ; \no_clock_is_off_EN
(define-fun |output_gate_n no_clock_is_off_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#83| state)) #b1))
(define-fun |output_gate#84| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#55| state)) #b1) #b0 #b1)) ; $procmux$674_Y
(define-fun |output_gate#85| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#15| state)) #b1) (|output_gate#84| state) #b0)) ; \nonsense_is_off_EN
(define-fun |output_gate_n nonsense_is_off_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#85| state)) #b1))
(declare-fun |output_gate#86| (|output_gate_s|) (_ BitVec 64)) ; \now_i
(define-fun |output_gate_n now_i| ((state |output_gate_s|)) (_ BitVec 64) (|output_gate#86| state))
(define-fun |output_gate_n off_o| ((state |output_gate_s|)) Bool (|output_gate#53| state))
(define-fun |output_gate_n on| ((state |output_gate_s|)) Bool (|output_gate#25| state))
(define-fun |output_gate_n on_later_q| ((state |output_gate_s|)) (_ BitVec 3) (|output_gate#26| state))
(define-fun |output_gate#87| ((state |output_gate_s|)) Bool (distinct (concat (|output_gate#43| state) (concat (ite (|output_gate#41| state) #b1 #b0) (concat (ite (|output_gate#39| state) #b1 #b0) (concat (ite (|output_gate#36| state) #b1 #b0) (ite (|output_gate#35| state) #b1 #b0))))) #b000000000)) ; \shut
(define-fun |output_gate#88| ((state |output_gate_s|)) Bool (not (or  (|output_gate#87| state) false))) ; $logic_not$output_gate.v:89$29_Y
(define-fun |output_gate#89| ((state |output_gate_s|)) Bool (and (or  (|output_gate#54| state) false) (or  (|output_gate#88| state) false))) ; \stays
(define-fun |output_gate#90| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 2 2) (|output_gate#26| state)) #b1) false) (or  (|output_gate#89| state) false))) ; \open
(define-fun |output_gate_n open| ((state |output_gate_s|)) Bool (|output_gate#90| state))
(declare-fun |output_gate#91| (|output_gate_s|) (_ BitVec 1)) ; \permit_1_q
(define-fun |output_gate_n permit_1_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#91| state)) #b1))
(declare-fun |output_gate#92| (|output_gate_s|) Bool) ; \ramp_done_i
(define-fun |output_gate_n ramp_done_i| ((state |output_gate_s|)) Bool (|output_gate#92| state))
(define-fun |output_gate_n ramp_down_o| ((state |output_gate_s|)) Bool (|output_gate#23| state))
(define-fun |output_gate_n ramp_up_o| ((state |output_gate_s|)) Bool (|output_gate#19| state))
(define-fun |output_gate#93| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#67| state)) #b1) #b1 #b0)) ; $procmux$699_Y
(define-fun |output_gate#94| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#15| state)) #b1) (|output_gate#93| state) #b0)) ; \reset_is_off_EN
(define-fun |output_gate_n reset_is_off_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#94| state)) #b1))
(declare-fun |output_gate#95| (|output_gate_s|) (_ BitVec 1)) ; \resting_1_q
(define-fun |output_gate#96| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 0 0) (|output_gate#95| state)) #b1) false) (or  (|output_gate#68| state) false))) ; $logic_and$output_gate_properties.vh:61$184_Y
(define-fun |output_gate#97| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#96| state) #b1 #b0)) ; $procmux$643_Y
(define-fun |output_gate#98| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#15| state)) #b1) (|output_gate#97| state) #b0)) ; \rest_is_kept_EN
(define-fun |output_gate_n rest_is_kept_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#98| state)) #b1))
(declare-fun |output_gate#99| (|output_gate_s|) (_ BitVec 32)) ; \rest_left_q
(define-fun |output_gate_n rest_left_q| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#99| state))
(define-fun |output_gate_n resting_1_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#95| state)) #b1))
(declare-fun |output_gate#100| (|output_gate_s|) (_ BitVec 1)) ; \resting_q
(define-fun |output_gate_n resting_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#100| state)) #b1))
(define-fun |output_gate_n rst_1_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#67| state)) #b1))
(declare-fun |output_gate#101| (|output_gate_s|) Bool) ; \rst_i
(define-fun |output_gate_n rst_i| ((state |output_gate_s|)) Bool (|output_gate#101| state))
(define-fun |output_gate_n run_permit_i| ((state |output_gate_s|)) Bool (|output_gate#33| state))
(declare-fun |output_gate#102| (|output_gate_s|) (_ BitVec 16)) ; \settle_left_q
(define-fun |output_gate_n settle_left_q| ((state |output_gate_s|)) (_ BitVec 16) (|output_gate#102| state))
(declare-fun |output_gate#103| (|output_gate_s|) Bool) ; \settled_i
(define-fun |output_gate_n settled_i| ((state |output_gate_s|)) Bool (|output_gate#103| state))
(define-fun |output_gate_n settling| ((state |output_gate_s|)) Bool (|output_gate#18| state))
(define-fun |output_gate_n settling_o| ((state |output_gate_s|)) Bool (|output_gate#18| state))
(define-fun |output_gate_n shut| ((state |output_gate_s|)) Bool (|output_gate#87| state))
(define-fun |output_gate_n shut_o| ((state |output_gate_s|)) Bool (|output_gate#87| state))
(declare-fun |output_gate#104| (|output_gate_s|) (_ BitVec 1)) ; \silent_1_q
(define-fun |output_gate#105| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#104| state)) #b1) #b1 #b0)) ; $procmux$653_Y
(define-fun |output_gate#106| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#69| state) (|output_gate#105| state) #b0)) ; $procmux$655_Y
(define-fun |output_gate#107| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#15| state)) #b1) (|output_gate#106| state) #b0)) ; \silence_is_kept_EN
(define-fun |output_gate_n silence_is_kept_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#107| state)) #b1))
(declare-fun |output_gate#108| (|output_gate_s|) (_ BitVec 32)) ; \silence_q
(define-fun |output_gate_n silence_q| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#108| state))
(define-fun |output_gate_n silent_1_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#104| state)) #b1))
(define-fun |output_gate#109| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#15| state)) #b1) (|output_gate#105| state) #b0)) ; \silent_is_off_EN
(define-fun |output_gate_n silent_is_off_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#109| state)) #b1))
(define-fun |output_gate_n silent_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#7| state)) #b1))
(define-fun |output_gate_n started_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#15| state)) #b1))
(define-fun |output_gate_n state_q| ((state |output_gate_s|)) (_ BitVec 3) (|output_gate#10| state))
(define-fun |output_gate_n stays| ((state |output_gate_s|)) Bool (|output_gate#89| state))
(define-fun |output_gate#110| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#91| state)) #b1) #b0 #b1)) ; $procmux$667_Y
(define-fun |output_gate#111| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#69| state) (|output_gate#110| state) #b0)) ; $procmux$669_Y
(define-fun |output_gate#112| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#15| state)) #b1) (|output_gate#111| state) #b0)) ; \stop_is_kept_EN
(define-fun |output_gate_n stop_is_kept_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#112| state)) #b1))
(define-fun |output_gate#113| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#15| state)) #b1) (|output_gate#110| state) #b0)) ; \stopped_is_off_EN
(define-fun |output_gate_n stopped_is_off_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#113| state)) #b1))
(define-fun |output_gate_n stopping_o| ((state |output_gate_s|)) Bool (|output_gate#21| state))
(define-fun |output_gate_n supply_has_settled_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#78| state)) #b1))
(define-fun |output_gate_n temperature_good_i| ((state |output_gate_s|)) Bool (|output_gate#37| state))
(define-fun |output_gate_n underrun_i| ((state |output_gate_s|)) Bool (|output_gate#40| state))
(declare-fun |output_gate#114| (|output_gate_s|) (_ BitVec 32)) ; \underruns_q
(define-fun |output_gate_n underruns_o| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#114| state))
(define-fun |output_gate_n underruns_q| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#114| state))
(declare-fun |output_gate#115| (|output_gate_s|) (_ BitVec 17)) ; \up_q
(define-fun |output_gate_n up_q| ((state |output_gate_s|)) (_ BitVec 17) (|output_gate#115| state))
(define-fun |output_gate#116| ((state |output_gate_s|)) (_ BitVec 1) (bvnot (ite (|output_gate#47| state) #b1 #b0))) ; $auto$rtlil.cc:3245:Not$932
(define-fun |output_gate_u 0| ((state |output_gate_s|)) Bool (or (= ((_ extract 0 0) (|output_gate#116| state)) #b1) (not true))) ; $auto$formalff.cc:987:execute$933
(define-fun |output_gate#117| ((state |output_gate_s|)) Bool (bvule (|output_gate#5| state) #b01111010000100100)) ; $le$output_gate_properties.vh:69$207_Y
(define-fun |output_gate#118| ((state |output_gate_s|)) Bool (bvule (|output_gate#1| state) #b01111010000100100)) ; $le$output_gate_properties.vh:69$208_Y
(define-fun |output_gate#119| ((state |output_gate_s|)) Bool (and (or  (|output_gate#117| state) false) (or  (|output_gate#118| state) false))) ; $logic_and$output_gate_properties.vh:69$209_Y
(define-fun |output_gate#120| ((state |output_gate_s|)) Bool (bvule (|output_gate#2| state) #b01111010000100100)) ; $le$output_gate_properties.vh:69$210_Y
(define-fun |output_gate#121| ((state |output_gate_s|)) Bool (and (or  (|output_gate#119| state) false) (or  (|output_gate#120| state) false))) ; $logic_and$output_gate_properties.vh:69$211_Y
(define-fun |output_gate#122| ((state |output_gate_s|)) Bool (bvule (|output_gate#3| state) #b01111010000100100)) ; $le$output_gate_properties.vh:69$212_Y
(define-fun |output_gate#123| ((state |output_gate_s|)) Bool (and (or  (|output_gate#121| state) false) (or  (|output_gate#122| state) false))) ; $logic_and$output_gate_properties.vh:69$213_Y
(define-fun |output_gate#124| ((state |output_gate_s|)) Bool (bvule (|output_gate#4| state) #b01111010000100100)) ; $le$output_gate_properties.vh:69$214_Y
(define-fun |output_gate#125| ((state |output_gate_s|)) Bool (and (or  (|output_gate#123| state) false) (or  (|output_gate#124| state) false))) ; $logic_and$output_gate_properties.vh:69$215_Y
(define-fun |output_gate#126| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#30| state)) #b1) #b0 #b1)) ; $procmux$623_Y
(define-fun |output_gate#127| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#15| state)) #b1) (|output_gate#126| state) #b0)) ; $assert$output_gate_properties.vh:69$206_EN
(define-fun |output_gate_a 0| ((state |output_gate_s|)) Bool (or (|output_gate#125| state) (not (= ((_ extract 0 0) (|output_gate#127| state)) #b1)))) ; _witness_.assert_assert_output_gate_properties_vh_69_206
(define-fun |output_gate#128| ((state |output_gate_s|)) Bool (bvule (|output_gate#115| state) #b01111010000100100)) ; $le$output_gate_properties.vh:70$217_Y
(define-fun |output_gate_a 1| ((state |output_gate_s|)) Bool (or (|output_gate#128| state) (not (= ((_ extract 0 0) (|output_gate#127| state)) #b1)))) ; _witness_.assert_assert_output_gate_properties_vh_70_216
(define-fun |output_gate#129| ((state |output_gate_s|)) Bool (bvult (|output_gate#5| state) #b01111010000100100)) ; $lt$output_gate_properties.vh:71$220_Y
(define-fun |output_gate#130| ((state |output_gate_s|)) (_ BitVec 17) (bvsub #b01111010000100011 (|output_gate#5| state))) ; $sub$output_gate_properties.vh:71$221_Y
(define-fun |output_gate#131| ((state |output_gate_s|)) Bool (= (concat #b0 (|output_gate#102| state)) (|output_gate#130| state))) ; $eq$output_gate_properties.vh:71$222_Y
(define-fun |output_gate#132| ((state |output_gate_s|)) Bool (and (or  (|output_gate#129| state) false) (or  (|output_gate#131| state) false))) ; $logic_and$output_gate_properties.vh:71$223_Y
(define-fun |output_gate#133| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#18| state) #b1 #b0)) ; $procmux$615_Y
(define-fun |output_gate#134| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#30| state)) #b1) #b0 (|output_gate#133| state))) ; $procmux$617_Y
(define-fun |output_gate#135| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#15| state)) #b1) (|output_gate#134| state) #b0)) ; $assert$output_gate_properties.vh:71$219_EN
(define-fun |output_gate_a 2| ((state |output_gate_s|)) Bool (or (|output_gate#132| state) (not (= ((_ extract 0 0) (|output_gate#135| state)) #b1)))) ; _witness_.assert_assert_output_gate_properties_vh_71_219
(define-fun |output_gate#136| ((state |output_gate_s|)) Bool (= (|output_gate#1| state) #b01111010000100100)) ; $eq$output_gate_properties.vh:14$242_Y
(define-fun |output_gate#137| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 0 0) (|output_gate#26| state)) #b1) false) (or  (|output_gate#136| state) false))) ; $logic_and$output_gate_properties.vh:73$227_Y
(define-fun |output_gate#138| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#79| state)) #b1) #b1 #b0)) ; $procmux$599_Y
(define-fun |output_gate#139| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#30| state)) #b1) #b0 (|output_gate#138| state))) ; $procmux$601_Y
(define-fun |output_gate#140| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#15| state)) #b1) (|output_gate#139| state) #b0)) ; $assert$output_gate_properties.vh:73$225_EN
(define-fun |output_gate_a 3| ((state |output_gate_s|)) Bool (or (|output_gate#137| state) (not (= ((_ extract 0 0) (|output_gate#140| state)) #b1)))) ; _witness_.assert_assert_output_gate_properties_vh_73_225
(define-fun |output_gate#141| ((state |output_gate_s|)) Bool (= (|output_gate#2| state) #b01111010000100100)) ; $eq$output_gate_properties.vh:14$252_Y
(define-fun |output_gate#142| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 1 1) (|output_gate#26| state)) #b1) false) (or  (|output_gate#141| state) false))) ; $logic_and$output_gate_properties.vh:74$230_Y
(define-fun |output_gate#143| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 1 1) (|output_gate#79| state)) #b1) #b1 #b0)) ; $procmux$591_Y
(define-fun |output_gate#144| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#30| state)) #b1) #b0 (|output_gate#143| state))) ; $procmux$593_Y
(define-fun |output_gate#145| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#15| state)) #b1) (|output_gate#144| state) #b0)) ; $assert$output_gate_properties.vh:74$228_EN
(define-fun |output_gate_a 4| ((state |output_gate_s|)) Bool (or (|output_gate#142| state) (not (= ((_ extract 0 0) (|output_gate#145| state)) #b1)))) ; _witness_.assert_assert_output_gate_properties_vh_74_228
(define-fun |output_gate#146| ((state |output_gate_s|)) Bool (= (|output_gate#3| state) #b01111010000100100)) ; $eq$output_gate_properties.vh:14$262_Y
(define-fun |output_gate#147| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 2 2) (|output_gate#26| state)) #b1) false) (or  (|output_gate#146| state) false))) ; $logic_and$output_gate_properties.vh:75$233_Y
(define-fun |output_gate#148| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 2 2) (|output_gate#79| state)) #b1) #b1 #b0)) ; $procmux$583_Y
(define-fun |output_gate#149| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#30| state)) #b1) #b0 (|output_gate#148| state))) ; $procmux$585_Y
(define-fun |output_gate#150| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#15| state)) #b1) (|output_gate#149| state) #b0)) ; $assert$output_gate_properties.vh:75$231_EN
(define-fun |output_gate_a 5| ((state |output_gate_s|)) Bool (or (|output_gate#147| state) (not (= ((_ extract 0 0) (|output_gate#150| state)) #b1)))) ; _witness_.assert_assert_output_gate_properties_vh_75_231
(define-fun |output_gate#151| ((state |output_gate_s|)) Bool (= (|output_gate#4| state) #b01111010000100100)) ; $eq$output_gate_properties.vh:14$272_Y
(define-fun |output_gate#152| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 0 0) (|output_gate#31| state)) #b1) false) (or  (|output_gate#151| state) false))) ; $logic_and$output_gate_properties.vh:76$237_Y
(define-fun |output_gate#153| ((state |output_gate_s|)) Bool (distinct (|output_gate#45| state) #b00000000000000000000000000000000)) ; $ne$output_gate_properties.vh:76$234_Y
(define-fun |output_gate#154| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#153| state) #b1 #b0)) ; $procmux$575_Y
(define-fun |output_gate#155| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#30| state)) #b1) #b0 (|output_gate#154| state))) ; $procmux$577_Y
(define-fun |output_gate#156| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#15| state)) #b1) (|output_gate#155| state) #b0)) ; $assert$output_gate_properties.vh:76$235_EN
(define-fun |output_gate_a 6| ((state |output_gate_s|)) Bool (or (|output_gate#152| state) (not (= ((_ extract 0 0) (|output_gate#156| state)) #b1)))) ; _witness_.assert_assert_output_gate_properties_vh_76_235
(define-fun |output_gate#157| ((state |output_gate_s|)) (_ BitVec 17) (bvadd (|output_gate#1| state) #b00000000000000001)) ; $add$output_gate_properties.vh:14$243_Y
(define-fun |output_gate#158| ((state |output_gate_s|)) (_ BitVec 17) (ite (|output_gate#136| state) #b01111010000100100 (|output_gate#157| state))) ; $ternary$output_gate_properties.vh:14$244_Y
(define-fun |output_gate#159| ((state |output_gate_s|)) Bool (= (|output_gate#5| state) (|output_gate#158| state))) ; $eq$output_gate_properties.vh:77$246_Y
(define-fun |output_gate#160| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 0 0) (|output_gate#26| state)) #b1) false) (or  (|output_gate#159| state) false))) ; $logic_and$output_gate_properties.vh:77$247_Y
(define-fun |output_gate#161| ((state |output_gate_s|)) Bool (distinct (|output_gate#5| state) #b00000000000000000)) ; $ne$output_gate_properties.vh:77$238_Y
(define-fun |output_gate#162| ((state |output_gate_s|)) Bool (and (or  (|output_gate#25| state) false) (or  (|output_gate#161| state) false))) ; $logic_and$output_gate_properties.vh:77$239_Y
(define-fun |output_gate#163| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#162| state) #b1 #b0)) ; $procmux$567_Y
(define-fun |output_gate#164| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#30| state)) #b1) #b0 (|output_gate#163| state))) ; $procmux$569_Y
(define-fun |output_gate#165| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#15| state)) #b1) (|output_gate#164| state) #b0)) ; $assert$output_gate_properties.vh:77$245_EN
(define-fun |output_gate_a 7| ((state |output_gate_s|)) Bool (or (|output_gate#160| state) (not (= ((_ extract 0 0) (|output_gate#165| state)) #b1)))) ; _witness_.assert_assert_output_gate_properties_vh_77_245
(define-fun |output_gate#166| ((state |output_gate_s|)) (_ BitVec 17) (bvadd (|output_gate#2| state) #b00000000000000001)) ; $add$output_gate_properties.vh:14$253_Y
(define-fun |output_gate#167| ((state |output_gate_s|)) (_ BitVec 17) (ite (|output_gate#141| state) #b01111010000100100 (|output_gate#166| state))) ; $ternary$output_gate_properties.vh:14$254_Y
(define-fun |output_gate#168| ((state |output_gate_s|)) Bool (= (|output_gate#1| state) (|output_gate#167| state))) ; $eq$output_gate_properties.vh:78$256_Y
(define-fun |output_gate#169| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 1 1) (|output_gate#26| state)) #b1) false) (or  (|output_gate#168| state) false))) ; $logic_and$output_gate_properties.vh:78$257_Y
(define-fun |output_gate#170| ((state |output_gate_s|)) Bool (distinct (|output_gate#1| state) #b00000000000000000)) ; $ne$output_gate_properties.vh:78$248_Y
(define-fun |output_gate#171| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 0 0) (|output_gate#26| state)) #b1) false) (or  (|output_gate#170| state) false))) ; $logic_and$output_gate_properties.vh:78$249_Y
(define-fun |output_gate#172| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#171| state) #b1 #b0)) ; $procmux$558_Y
(define-fun |output_gate#173| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#30| state)) #b1) #b0 (|output_gate#172| state))) ; $procmux$560_Y
(define-fun |output_gate#174| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#15| state)) #b1) (|output_gate#173| state) #b0)) ; $assert$output_gate_properties.vh:78$255_EN
(define-fun |output_gate_a 8| ((state |output_gate_s|)) Bool (or (|output_gate#169| state) (not (= ((_ extract 0 0) (|output_gate#174| state)) #b1)))) ; _witness_.assert_assert_output_gate_properties_vh_78_255
(define-fun |output_gate#175| ((state |output_gate_s|)) (_ BitVec 17) (bvadd (|output_gate#3| state) #b00000000000000001)) ; $add$output_gate_properties.vh:14$263_Y
(define-fun |output_gate#176| ((state |output_gate_s|)) (_ BitVec 17) (ite (|output_gate#146| state) #b01111010000100100 (|output_gate#175| state))) ; $ternary$output_gate_properties.vh:14$264_Y
(define-fun |output_gate#177| ((state |output_gate_s|)) Bool (= (|output_gate#2| state) (|output_gate#176| state))) ; $eq$output_gate_properties.vh:79$266_Y
(define-fun |output_gate#178| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 2 2) (|output_gate#26| state)) #b1) false) (or  (|output_gate#177| state) false))) ; $logic_and$output_gate_properties.vh:79$267_Y
(define-fun |output_gate#179| ((state |output_gate_s|)) Bool (distinct (|output_gate#2| state) #b00000000000000000)) ; $ne$output_gate_properties.vh:79$258_Y
(define-fun |output_gate#180| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 1 1) (|output_gate#26| state)) #b1) false) (or  (|output_gate#179| state) false))) ; $logic_and$output_gate_properties.vh:79$259_Y
(define-fun |output_gate#181| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#180| state) #b1 #b0)) ; $procmux$549_Y
(define-fun |output_gate#182| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#30| state)) #b1) #b0 (|output_gate#181| state))) ; $procmux$551_Y
(define-fun |output_gate#183| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#15| state)) #b1) (|output_gate#182| state) #b0)) ; $assert$output_gate_properties.vh:79$265_EN
(define-fun |output_gate_a 9| ((state |output_gate_s|)) Bool (or (|output_gate#178| state) (not (= ((_ extract 0 0) (|output_gate#183| state)) #b1)))) ; _witness_.assert_assert_output_gate_properties_vh_79_265
(define-fun |output_gate#184| ((state |output_gate_s|)) (_ BitVec 17) (bvadd (|output_gate#4| state) #b00000000000000001)) ; $add$output_gate_properties.vh:14$273_Y
(define-fun |output_gate#185| ((state |output_gate_s|)) (_ BitVec 17) (ite (|output_gate#151| state) #b01111010000100100 (|output_gate#184| state))) ; $ternary$output_gate_properties.vh:14$274_Y
(define-fun |output_gate#186| ((state |output_gate_s|)) Bool (= (|output_gate#3| state) (|output_gate#185| state))) ; $eq$output_gate_properties.vh:80$276_Y
(define-fun |output_gate#187| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 0 0) (|output_gate#31| state)) #b1) false) (or  (|output_gate#186| state) false))) ; $logic_and$output_gate_properties.vh:80$277_Y
(define-fun |output_gate#188| ((state |output_gate_s|)) Bool (distinct (|output_gate#3| state) #b00000000000000000)) ; $ne$output_gate_properties.vh:80$268_Y
(define-fun |output_gate#189| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 2 2) (|output_gate#26| state)) #b1) false) (or  (|output_gate#188| state) false))) ; $logic_and$output_gate_properties.vh:80$269_Y
(define-fun |output_gate#190| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#189| state) #b1 #b0)) ; $procmux$540_Y
(define-fun |output_gate#191| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#30| state)) #b1) #b0 (|output_gate#190| state))) ; $procmux$542_Y
(define-fun |output_gate#192| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#15| state)) #b1) (|output_gate#191| state) #b0)) ; $assert$output_gate_properties.vh:80$275_EN
(define-fun |output_gate_a 10| ((state |output_gate_s|)) Bool (or (|output_gate#187| state) (not (= ((_ extract 0 0) (|output_gate#192| state)) #b1)))) ; _witness_.assert_assert_output_gate_properties_vh_80_275
(define-fun |output_gate#193| ((state |output_gate_s|)) Bool (bvuge (|output_gate#115| state) (|output_gate#4| state))) ; $ge$output_gate_properties.vh:81$279_Y
(define-fun |output_gate#194| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#31| state)) #b1) #b1 #b0)) ; $procmux$531_Y
(define-fun |output_gate#195| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#30| state)) #b1) #b0 (|output_gate#194| state))) ; $procmux$533_Y
(define-fun |output_gate#196| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#15| state)) #b1) (|output_gate#195| state) #b0)) ; $assert$output_gate_properties.vh:81$278_EN
(define-fun |output_gate_a 11| ((state |output_gate_s|)) Bool (or (|output_gate#193| state) (not (= ((_ extract 0 0) (|output_gate#196| state)) #b1)))) ; _witness_.assert_assert_output_gate_properties_vh_81_278
(define-fun |output_gate#197| ((state |output_gate_s|)) Bool (|output_gate_is| state)) ; $auto$rtlil.cc:3293:And$754
(define-fun |output_gate_u 1| ((state |output_gate_s|)) Bool (or (|output_gate#101| state) (not (|output_gate#197| state)))) ; _witness_.assume_assume_output_gate_properties_vh_18_282
(define-fun |output_gate#198| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#30| state)) #b1) false))) ; $logic_not$output_gate_properties.vh:20$86_Y
(define-fun |output_gate#199| ((state |output_gate_s|)) Bool (or  (|output_gate#198| state) false  (|output_gate#101| state) false)) ; $logic_or$output_gate_properties.vh:20$87_Y
(define-fun |output_gate_u 2| ((state |output_gate_s|)) Bool (or (|output_gate#199| state) (not true))) ; _witness_.assume_assume_output_gate_properties_vh_20_85
(define-fun |output_gate#200| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#45| state)) #b1) (= ((_ extract 1 1) (|output_gate#45| state)) #b1) (= ((_ extract 2 2) (|output_gate#45| state)) #b1) (= ((_ extract 3 3) (|output_gate#45| state)) #b1) (= ((_ extract 4 4) (|output_gate#45| state)) #b1) (= ((_ extract 5 5) (|output_gate#45| state)) #b1) (= ((_ extract 6 6) (|output_gate#45| state)) #b1) (= ((_ extract 7 7) (|output_gate#45| state)) #b1) (= ((_ extract 8 8) (|output_gate#45| state)) #b1) (= ((_ extract 9 9) (|output_gate#45| state)) #b1) (= ((_ extract 10 10) (|output_gate#45| state)) #b1) (= ((_ extract 11 11) (|output_gate#45| state)) #b1) (= ((_ extract 12 12) (|output_gate#45| state)) #b1) (= ((_ extract 13 13) (|output_gate#45| state)) #b1) (= ((_ extract 14 14) (|output_gate#45| state)) #b1) (= ((_ extract 15 15) (|output_gate#45| state)) #b1) (= ((_ extract 16 16) (|output_gate#45| state)) #b1) (= ((_ extract 17 17) (|output_gate#45| state)) #b1) (= ((_ extract 18 18) (|output_gate#45| state)) #b1) (= ((_ extract 19 19) (|output_gate#45| state)) #b1) (= ((_ extract 20 20) (|output_gate#45| state)) #b1) (= ((_ extract 21 21) (|output_gate#45| state)) #b1) (= ((_ extract 22 22) (|output_gate#45| state)) #b1) (= ((_ extract 23 23) (|output_gate#45| state)) #b1) (= ((_ extract 24 24) (|output_gate#45| state)) #b1) (= ((_ extract 25 25) (|output_gate#45| state)) #b1) (= ((_ extract 26 26) (|output_gate#45| state)) #b1) (= ((_ extract 27 27) (|output_gate#45| state)) #b1) (= ((_ extract 28 28) (|output_gate#45| state)) #b1) (= ((_ extract 29 29) (|output_gate#45| state)) #b1) (= ((_ extract 30 30) (|output_gate#45| state)) #b1) (= ((_ extract 31 31) (|output_gate#45| state)) #b1)))) ; $eq$output_gate_properties.vh:23$89_Y
(define-fun |output_gate#201| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#31| state)) #b1) false))) ; $logic_not$output_gate_properties.vh:23$90_Y
(define-fun |output_gate#202| ((state |output_gate_s|)) Bool (and (or  (|output_gate#200| state) false) (or  (|output_gate#201| state) false))) ; $logic_and$output_gate_properties.vh:23$91_Y
(define-fun |output_gate_a 12| ((state |output_gate_s|)) Bool (or (|output_gate#202| state) (not (= ((_ extract 0 0) (|output_gate#16| state)) #b1)))) ; beyond_is_off
(define-fun |output_gate_a 13| ((state |output_gate_s|)) Bool (or (= ((_ extract 2 2) (|output_gate#57| state)) #b1) (not (= ((_ extract 0 0) (|output_gate#71| state)) #b1)))) ; heat_is_kept
(define-fun |output_gate_a 14| ((state |output_gate_s|)) Bool (or (|output_gate#202| state) (not (= ((_ extract 0 0) (|output_gate#72| state)) #b1)))) ; hot_is_off
(define-fun |output_gate#203| ((state |output_gate_s|)) (_ BitVec 32) (bvnot (concat #b000000000000000000000000000 ((_ extract 8 4) (|output_gate#57| state))))) ; $not$output_gate_properties.vh:59$180_Y
(define-fun |output_gate#204| ((state |output_gate_s|)) (_ BitVec 32) (bvand (concat #b000000000000000000000000000 (|output_gate#12| state)) (|output_gate#203| state))) ; $and$output_gate_properties.vh:59$181_Y
(define-fun |output_gate#205| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#204| state)) #b1) (= ((_ extract 1 1) (|output_gate#204| state)) #b1) (= ((_ extract 2 2) (|output_gate#204| state)) #b1) (= ((_ extract 3 3) (|output_gate#204| state)) #b1) (= ((_ extract 4 4) (|output_gate#204| state)) #b1) (= ((_ extract 5 5) (|output_gate#204| state)) #b1) (= ((_ extract 6 6) (|output_gate#204| state)) #b1) (= ((_ extract 7 7) (|output_gate#204| state)) #b1) (= ((_ extract 8 8) (|output_gate#204| state)) #b1) (= ((_ extract 9 9) (|output_gate#204| state)) #b1) (= ((_ extract 10 10) (|output_gate#204| state)) #b1) (= ((_ extract 11 11) (|output_gate#204| state)) #b1) (= ((_ extract 12 12) (|output_gate#204| state)) #b1) (= ((_ extract 13 13) (|output_gate#204| state)) #b1) (= ((_ extract 14 14) (|output_gate#204| state)) #b1) (= ((_ extract 15 15) (|output_gate#204| state)) #b1) (= ((_ extract 16 16) (|output_gate#204| state)) #b1) (= ((_ extract 17 17) (|output_gate#204| state)) #b1) (= ((_ extract 18 18) (|output_gate#204| state)) #b1) (= ((_ extract 19 19) (|output_gate#204| state)) #b1) (= ((_ extract 20 20) (|output_gate#204| state)) #b1) (= ((_ extract 21 21) (|output_gate#204| state)) #b1) (= ((_ extract 22 22) (|output_gate#204| state)) #b1) (= ((_ extract 23 23) (|output_gate#204| state)) #b1) (= ((_ extract 24 24) (|output_gate#204| state)) #b1) (= ((_ extract 25 25) (|output_gate#204| state)) #b1) (= ((_ extract 26 26) (|output_gate#204| state)) #b1) (= ((_ extract 27 27) (|output_gate#204| state)) #b1) (= ((_ extract 28 28) (|output_gate#204| state)) #b1) (= ((_ extract 29 29) (|output_gate#204| state)) #b1) (= ((_ extract 30 30) (|output_gate#204| state)) #b1) (= ((_ extract 31 31) (|output_gate#204| state)) #b1)))) ; $eq$output_gate_properties.vh:59$182_Y
(define-fun |output_gate_a 15| ((state |output_gate_s|)) Bool (or (|output_gate#205| state) (not (= ((_ extract 0 0) (|output_gate#76| state)) #b1)))) ; limits_are_kept
(define-fun |output_gate#206| ((state |output_gate_s|)) (_ BitVec 32) (bvnot (|output_gate#77| state))) ; $not$output_gate_properties.vh:64$191_Y
(define-fun |output_gate#207| ((state |output_gate_s|)) (_ BitVec 32) (bvand (|output_gate#45| state) (|output_gate#206| state))) ; $and$output_gate_properties.vh:64$192_Y
(define-fun |output_gate#208| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#207| state)) #b1) (= ((_ extract 1 1) (|output_gate#207| state)) #b1) (= ((_ extract 2 2) (|output_gate#207| state)) #b1) (= ((_ extract 3 3) (|output_gate#207| state)) #b1) (= ((_ extract 4 4) (|output_gate#207| state)) #b1) (= ((_ extract 5 5) (|output_gate#207| state)) #b1) (= ((_ extract 6 6) (|output_gate#207| state)) #b1) (= ((_ extract 7 7) (|output_gate#207| state)) #b1) (= ((_ extract 8 8) (|output_gate#207| state)) #b1) (= ((_ extract 9 9) (|output_gate#207| state)) #b1) (= ((_ extract 10 10) (|output_gate#207| state)) #b1) (= ((_ extract 11 11) (|output_gate#207| state)) #b1) (= ((_ extract 12 12) (|output_gate#207| state)) #b1) (= ((_ extract 13 13) (|output_gate#207| state)) #b1) (= ((_ extract 14 14) (|output_gate#207| state)) #b1) (= ((_ extract 15 15) (|output_gate#207| state)) #b1) (= ((_ extract 16 16) (|output_gate#207| state)) #b1) (= ((_ extract 17 17) (|output_gate#207| state)) #b1) (= ((_ extract 18 18) (|output_gate#207| state)) #b1) (= ((_ extract 19 19) (|output_gate#207| state)) #b1) (= ((_ extract 20 20) (|output_gate#207| state)) #b1) (= ((_ extract 21 21) (|output_gate#207| state)) #b1) (= ((_ extract 22 22) (|output_gate#207| state)) #b1) (= ((_ extract 23 23) (|output_gate#207| state)) #b1) (= ((_ extract 24 24) (|output_gate#207| state)) #b1) (= ((_ extract 25 25) (|output_gate#207| state)) #b1) (= ((_ extract 26 26) (|output_gate#207| state)) #b1) (= ((_ extract 27 27) (|output_gate#207| state)) #b1) (= ((_ extract 28 28) (|output_gate#207| state)) #b1) (= ((_ extract 29 29) (|output_gate#207| state)) #b1) (= ((_ extract 30 30) (|output_gate#207| state)) #b1) (= ((_ extract 31 31) (|output_gate#207| state)) #b1)))) ; $eq$output_gate_properties.vh:64$193_Y
(define-fun |output_gate_a 16| ((state |output_gate_s|)) Bool (or (|output_gate#208| state) (not (= ((_ extract 0 0) (|output_gate#78| state)) #b1)))) ; mask_is_kept
(define-fun |output_gate#209| ((state |output_gate_s|)) Bool (= (|output_gate#5| state) #b01111010000100100)) ; $eq$output_gate_properties.vh:14$102_Y
(define-fun |output_gate_a 17| ((state |output_gate_s|)) Bool (or (|output_gate#209| state) (not (= ((_ extract 0 0) (|output_gate#82| state)) #b1)))) ; moves_once_settled
(define-fun |output_gate#210| ((state |output_gate_s|)) Bool (or  (|output_gate#200| state) false  (= ((_ extract 0 0) (|output_gate#31| state)) #b1) false)) ; $logic_or$output_gate_properties.vh:63$190_Y
(define-fun |output_gate_a 18| ((state |output_gate_s|)) Bool (or (|output_gate#210| state) (not (= ((_ extract 0 0) (|output_gate#78| state)) #b1)))) ; no_channel_alone
(define-fun |output_gate#211| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#74| state)) #b1) false))) ; $logic_not$output_gate_properties.vh:23$92_Y
(define-fun |output_gate#212| ((state |output_gate_s|)) Bool (and (or  (|output_gate#202| state) false) (or  (|output_gate#211| state) false))) ; $logic_and$output_gate_properties.vh:23$93_Y
(define-fun |output_gate#213| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#62| state)) #b1) false))) ; $logic_not$output_gate_properties.vh:23$94_Y
(define-fun |output_gate#214| ((state |output_gate_s|)) Bool (and (or  (|output_gate#212| state) false) (or  (|output_gate#213| state) false))) ; $logic_and$output_gate_properties.vh:23$95_Y
(define-fun |output_gate_a 19| ((state |output_gate_s|)) Bool (or (|output_gate#214| state) (not (= ((_ extract 0 0) (|output_gate#83| state)) #b1)))) ; no_clock_is_off
(define-fun |output_gate_a 20| ((state |output_gate_s|)) Bool (or (|output_gate#202| state) (not (= ((_ extract 0 0) (|output_gate#85| state)) #b1)))) ; nonsense_is_off
(define-fun |output_gate#215| ((state |output_gate_s|)) Bool (and (or  (|output_gate#202| state) false) (or  (|output_gate#53| state) false))) ; $logic_and$output_gate_properties.vh:47$155_Y
(define-fun |output_gate_a 21| ((state |output_gate_s|)) Bool (or (|output_gate#215| state) (not (= ((_ extract 0 0) (|output_gate#94| state)) #b1)))) ; reset_is_off
(define-fun |output_gate#216| ((state |output_gate_s|)) (_ BitVec 32) (bvand (concat #b000000000000000000000000000 (|output_gate#59| state)) (|output_gate#203| state))) ; $and$output_gate_properties.vh:61$187_Y
(define-fun |output_gate#217| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#216| state)) #b1) (= ((_ extract 1 1) (|output_gate#216| state)) #b1) (= ((_ extract 2 2) (|output_gate#216| state)) #b1) (= ((_ extract 3 3) (|output_gate#216| state)) #b1) (= ((_ extract 4 4) (|output_gate#216| state)) #b1) (= ((_ extract 5 5) (|output_gate#216| state)) #b1) (= ((_ extract 6 6) (|output_gate#216| state)) #b1) (= ((_ extract 7 7) (|output_gate#216| state)) #b1) (= ((_ extract 8 8) (|output_gate#216| state)) #b1) (= ((_ extract 9 9) (|output_gate#216| state)) #b1) (= ((_ extract 10 10) (|output_gate#216| state)) #b1) (= ((_ extract 11 11) (|output_gate#216| state)) #b1) (= ((_ extract 12 12) (|output_gate#216| state)) #b1) (= ((_ extract 13 13) (|output_gate#216| state)) #b1) (= ((_ extract 14 14) (|output_gate#216| state)) #b1) (= ((_ extract 15 15) (|output_gate#216| state)) #b1) (= ((_ extract 16 16) (|output_gate#216| state)) #b1) (= ((_ extract 17 17) (|output_gate#216| state)) #b1) (= ((_ extract 18 18) (|output_gate#216| state)) #b1) (= ((_ extract 19 19) (|output_gate#216| state)) #b1) (= ((_ extract 20 20) (|output_gate#216| state)) #b1) (= ((_ extract 21 21) (|output_gate#216| state)) #b1) (= ((_ extract 22 22) (|output_gate#216| state)) #b1) (= ((_ extract 23 23) (|output_gate#216| state)) #b1) (= ((_ extract 24 24) (|output_gate#216| state)) #b1) (= ((_ extract 25 25) (|output_gate#216| state)) #b1) (= ((_ extract 26 26) (|output_gate#216| state)) #b1) (= ((_ extract 27 27) (|output_gate#216| state)) #b1) (= ((_ extract 28 28) (|output_gate#216| state)) #b1) (= ((_ extract 29 29) (|output_gate#216| state)) #b1) (= ((_ extract 30 30) (|output_gate#216| state)) #b1) (= ((_ extract 31 31) (|output_gate#216| state)) #b1)))) ; $eq$output_gate_properties.vh:61$188_Y
(define-fun |output_gate_a 22| ((state |output_gate_s|)) Bool (or (|output_gate#217| state) (not (= ((_ extract 0 0) (|output_gate#98| state)) #b1)))) ; rest_is_kept
(define-fun |output_gate_a 23| ((state |output_gate_s|)) Bool (or (= ((_ extract 1 1) (|output_gate#57| state)) #b1) (not (= ((_ extract 0 0) (|output_gate#107| state)) #b1)))) ; silence_is_kept
(define-fun |output_gate_a 24| ((state |output_gate_s|)) Bool (or (|output_gate#202| state) (not (= ((_ extract 0 0) (|output_gate#109| state)) #b1)))) ; silent_is_off
(define-fun |output_gate_a 25| ((state |output_gate_s|)) Bool (or (= ((_ extract 0 0) (|output_gate#57| state)) #b1) (not (= ((_ extract 0 0) (|output_gate#112| state)) #b1)))) ; stop_is_kept
(define-fun |output_gate_a 26| ((state |output_gate_s|)) Bool (or (|output_gate#202| state) (not (= ((_ extract 0 0) (|output_gate#113| state)) #b1)))) ; stopped_is_off
(define-fun |output_gate#218| ((state |output_gate_s|)) Bool (bvuge (|output_gate#115| state) #b01111010000100100)) ; $ge$output_gate_properties.vh:65$195_Y
(define-fun |output_gate#219| ((state |output_gate_s|)) Bool (or  (|output_gate#200| state) false  (|output_gate#218| state) false)) ; $logic_or$output_gate_properties.vh:65$196_Y
(define-fun |output_gate_a 27| ((state |output_gate_s|)) Bool (or (|output_gate#219| state) (not (= ((_ extract 0 0) (|output_gate#78| state)) #b1)))) ; supply_has_settled
(define-fun |output_gate#220| ((state |output_gate_s|)) (_ BitVec 17) (bvadd (|output_gate#115| state) #b00000000000000001)) ; $add$output_gate_properties.vh:14$128_Y
(define-fun |output_gate#221| ((state |output_gate_s|)) Bool (= (|output_gate#115| state) #b01111010000100100)) ; $eq$output_gate_properties.vh:14$127_Y
(define-fun |output_gate#222| ((state |output_gate_s|)) (_ BitVec 17) (ite (|output_gate#221| state) #b01111010000100100 (|output_gate#220| state))) ; $0\longer$func$output_gate_properties.vh:42$2.$result[16:0]$99
(define-fun |output_gate#223| ((state |output_gate_s|)) Bool (or  (|output_gate#101| state) false  (|output_gate#201| state) false)) ; $logic_or$output_gate_properties.vh:42$131_Y
(define-fun |output_gate#224| ((state |output_gate_s|)) (_ BitVec 17) (ite (|output_gate#223| state) #b00000000000000000 (|output_gate#222| state))) ; $0\up_q[16:0]
(define-fun |output_gate#225| ((state |output_gate_s|)) (_ BitVec 32) (bvadd (|output_gate#114| state) #b00000000000000000000000000000001)) ; $add$output_gate.v:113$45_Y
(define-fun |output_gate#226| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#41| state) (|output_gate#225| state) (|output_gate#114| state))) ; $procmux$317_Y
(define-fun |output_gate#227| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#101| state) #b00000000000000000000000000000000 (|output_gate#226| state))) ; $0\underruns_q[31:0]
(define-fun |output_gate#228| ((state |output_gate_s|)) (_ BitVec 32) (bvsub (|output_gate#108| state) #b00000000000000000000000000000001)) ; $sub$output_gate.v:97$34_Y
(define-fun |output_gate#229| ((state |output_gate_s|)) (_ BitVec 32) (ite (= ((_ extract 0 0) (|output_gate#7| state)) #b1) (|output_gate#108| state) (|output_gate#228| state))) ; $procmux$346_Y
(define-fun |output_gate#230| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#63| state) (|output_gate#64| state) (|output_gate#229| state))) ; $procmux$349_Y
(define-fun |output_gate#231| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#101| state) #b00000000000000000000000000000000 (|output_gate#230| state))) ; $0\silence_q[31:0]
(define-fun |output_gate#232| ((state |output_gate_s|)) (_ BitVec 16) (bvsub (|output_gate#102| state) #b0000000000000001)) ; $sub$output_gate.v:126$47_Y
(define-fun |output_gate#233| ((state |output_gate_s|)) (_ BitVec 16) (ite (|output_gate#18| state) (|output_gate#232| state) #b1111010000100011)) ; $ternary$output_gate.v:126$48_Y
(define-fun |output_gate#234| ((state |output_gate_s|)) (_ BitVec 16) (ite (|output_gate#101| state) #b0000000000000000 (|output_gate#233| state))) ; $0\settle_left_q[15:0]
(define-fun |output_gate#235| ((state |output_gate_s|)) Bool (distinct (|output_gate#99| state) #b00000000000000000000000000000001)) ; $ne$output_gate.v:107$42_Y
(define-fun |output_gate#236| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#100| state)) #b1) (ite (|output_gate#235| state) #b1 #b0) #b0)) ; $procmux$325_Y
(define-fun |output_gate#237| ((state |output_gate_s|)) Bool (distinct (|output_gate#43| state) #b00000)) ; $ne$output_gate.v:102$40_Y
(define-fun |output_gate#238| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#237| state) #b1 (|output_gate#236| state))) ; $procmux$328_Y
(define-fun |output_gate#239| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#101| state) #b0 (|output_gate#238| state))) ; $0\resting_q[0:0]
(define-fun |output_gate#240| ((state |output_gate_s|)) (_ BitVec 32) (bvsub (|output_gate#99| state) #b00000000000000000000000000000001)) ; $sub$output_gate.v:106$41_Y
(define-fun |output_gate#241| ((state |output_gate_s|)) (_ BitVec 32) (ite (= ((_ extract 0 0) (|output_gate#100| state)) #b1) (|output_gate#240| state) (|output_gate#99| state))) ; $procmux$332_Y
(define-fun |output_gate#242| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#237| state) #b00000000111011100110101100101000 (|output_gate#241| state))) ; $procmux$335_Y
(define-fun |output_gate#243| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#101| state) #b00000000000000000000000000000000 (|output_gate#242| state))) ; $0\rest_left_q[31:0]
(define-fun |output_gate#244| ((state |output_gate_s|)) (_ BitVec 3) (bvand (concat ((_ extract 1 0) (|output_gate#79| state)) (ite (|output_gate#24| state) #b1 #b0)) (concat (ite (|output_gate#89| state) #b1 #b0) (concat (ite (|output_gate#89| state) #b1 #b0) (ite (|output_gate#89| state) #b1 #b0))))) ; $and$output_gate.v:128$50_Y
(define-fun |output_gate#245| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#101| state) #b000 (|output_gate#244| state))) ; $0\moves_later_q[2:0]
(define-fun |output_gate#246| ((state |output_gate_s|)) Bool (not (or  (|output_gate#101| state) false))) ; $logic_not$output_gate.v:165$62_Y
(define-fun |output_gate#247| ((state |output_gate_s|)) Bool (and (or  (|output_gate#90| state) false) (or  (|output_gate#246| state) false))) ; $0\hv_enable_q[0:0]
(define-fun |output_gate#248| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#6| state)) #b1) (= ((_ extract 1 1) (|output_gate#6| state)) #b1) (= ((_ extract 2 2) (|output_gate#6| state)) #b1) (= ((_ extract 3 3) (|output_gate#6| state)) #b1) (= ((_ extract 4 4) (|output_gate#6| state)) #b1) (= ((_ extract 5 5) (|output_gate#6| state)) #b1) (= ((_ extract 6 6) (|output_gate#6| state)) #b1) (= ((_ extract 7 7) (|output_gate#6| state)) #b1) (= ((_ extract 8 8) (|output_gate#6| state)) #b1) (= ((_ extract 9 9) (|output_gate#6| state)) #b1) (= ((_ extract 10 10) (|output_gate#6| state)) #b1) (= ((_ extract 11 11) (|output_gate#6| state)) #b1) (= ((_ extract 12 12) (|output_gate#6| state)) #b1) (= ((_ extract 13 13) (|output_gate#6| state)) #b1) (= ((_ extract 14 14) (|output_gate#6| state)) #b1) (= ((_ extract 15 15) (|output_gate#6| state)) #b1) (= ((_ extract 16 16) (|output_gate#6| state)) #b1) (= ((_ extract 17 17) (|output_gate#6| state)) #b1) (= ((_ extract 18 18) (|output_gate#6| state)) #b1) (= ((_ extract 19 19) (|output_gate#6| state)) #b1) (= ((_ extract 20 20) (|output_gate#6| state)) #b1) (= ((_ extract 21 21) (|output_gate#6| state)) #b1) (= ((_ extract 22 22) (|output_gate#6| state)) #b1) (= ((_ extract 23 23) (|output_gate#6| state)) #b1) (= ((_ extract 24 24) (|output_gate#6| state)) #b1) (= ((_ extract 25 25) (|output_gate#6| state)) #b1) (= ((_ extract 26 26) (|output_gate#6| state)) #b1) (= ((_ extract 27 27) (|output_gate#6| state)) #b1) (= ((_ extract 28 28) (|output_gate#6| state)) #b1) (= ((_ extract 29 29) (|output_gate#6| state)) #b1) (= ((_ extract 30 30) (|output_gate#6| state)) #b1) (= ((_ extract 31 31) (|output_gate#6| state)) #b1)))) ; $eq$output_gate.v:135$58_Y
(define-fun |output_gate#249| ((state |output_gate_s|)) (_ BitVec 1) (bvxor (|output_gate#74| state) (ite (|output_gate#248| state) #b1 #b0))) ; $xor$output_gate.v:167$71_Y
(define-fun |output_gate#250| ((state |output_gate_s|)) Bool (and (or  (|output_gate#247| state) false) (or  (= ((_ extract 0 0) (|output_gate#249| state)) #b1) false))) ; $0\hv_alive_q[0:0]
(define-fun |output_gate#251| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#30| state)) #b1) #b0 (ite (|output_gate#250| state) #b1 #b0))) ; $auto$rtlil.cc:3381:Mux$914
(define-fun |output_gate#252| ((state |output_gate_s|)) Bool (distinct (|output_gate#60| state) #b0000000000000000)) ; $ne$output_gate.v:133$55_Y
(define-fun |output_gate#253| ((state |output_gate_s|)) Bool (or  (|output_gate#52| state) false  (|output_gate#252| state) false)) ; $logic_or$output_gate.v:168$76_Y
(define-fun |output_gate#254| ((state |output_gate_s|)) Bool (and (or  (|output_gate#247| state) false) (or  (|output_gate#253| state) false))) ; $0\focus_q[0:0]
(define-fun |output_gate#255| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#30| state)) #b1) #b0 (ite (|output_gate#254| state) #b1 #b0))) ; $auto$rtlil.cc:3381:Mux$916
(define-fun |output_gate#256| ((state |output_gate_s|)) (_ BitVec 16) (bvsub (|output_gate#60| state) #b0000000000000001)) ; $sub$output_gate.v:133$56_Y
(define-fun |output_gate#257| ((state |output_gate_s|)) (_ BitVec 16) (ite (|output_gate#252| state) (|output_gate#256| state) (|output_gate#60| state))) ; $procmux$303_Y
(define-fun |output_gate#258| ((state |output_gate_s|)) (_ BitVec 16) (bvsub (|output_gate#17| state) #b0000000000000001)) ; $sub$output_gate.v:132$54_Y
(define-fun |output_gate#259| ((state |output_gate_s|)) (_ BitVec 16) (ite (|output_gate#52| state) (|output_gate#258| state) (|output_gate#257| state))) ; $procmux$306_Y
(define-fun |output_gate#260| ((state |output_gate_s|)) (_ BitVec 16) (ite (|output_gate#90| state) (|output_gate#259| state) #b0000000000000000)) ; $procmux$309_Y
(define-fun |output_gate#261| ((state |output_gate_s|)) (_ BitVec 16) (ite (|output_gate#101| state) #b0000000000000000 (|output_gate#260| state))) ; $0\focus_left_q[15:0]
(define-fun |output_gate#262| ((state |output_gate_s|)) (_ BitVec 64) (ite (|output_gate#87| state) (|output_gate#86| state) (|output_gate#58| state))) ; $procmux$313_Y
(define-fun |output_gate#263| ((state |output_gate_s|)) (_ BitVec 64) (ite (|output_gate#101| state) #b0000000000000000000000000000000000000000000000000000000000000000 (|output_gate#262| state))) ; $0\fault_time_q[63:0]
(define-fun |output_gate#264| ((state |output_gate_s|)) (_ BitVec 9) (bvand (concat ((_ extract 8 4) (|output_gate#57| state)) #b0000) (concat (|output_gate#100| state) (concat (|output_gate#100| state) (concat (|output_gate#100| state) (concat (|output_gate#100| state) (concat (|output_gate#100| state) (concat (|output_gate#100| state) (concat (|output_gate#100| state) (concat (|output_gate#100| state) (|output_gate#100| state))))))))))) ; $and$output_gate.v:101$37_Y
(define-fun |output_gate#265| ((state |output_gate_s|)) (_ BitVec 9) (ite (|output_gate#46| state) (|output_gate#264| state) (|output_gate#57| state))) ; $ternary$output_gate.v:101$38_Y
(define-fun |output_gate#266| ((state |output_gate_s|)) (_ BitVec 9) (bvor (|output_gate#265| state) (concat (|output_gate#43| state) (concat (ite (|output_gate#41| state) #b1 #b0) (concat (ite (|output_gate#39| state) #b1 #b0) (concat (ite (|output_gate#36| state) #b1 #b0) (ite (|output_gate#35| state) #b1 #b0))))))) ; $or$output_gate.v:101$39_Y
(define-fun |output_gate#267| ((state |output_gate_s|)) (_ BitVec 9) (ite (|output_gate#101| state) #b000000000 (|output_gate#266| state))) ; $0\fault_q[8:0]
(define-fun |output_gate#268| ((state |output_gate_s|)) (_ BitVec 32) (bvadd (|output_gate#56| state) #b00000000000000000000000000000001)) ; $add$output_gate.v:110$43_Y
(define-fun |output_gate#269| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#87| state) (|output_gate#268| state) (|output_gate#56| state))) ; $procmux$321_Y
(define-fun |output_gate#270| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#101| state) #b00000000000000000000000000000000 (|output_gate#269| state))) ; $0\fault_count_q[31:0]
(define-fun |output_gate#271| ((state |output_gate_s|)) Bool (bvule (|output_gate#10| state) #b101)) ; $0\exists_1_q[0:0]
(define-fun |output_gate#272| ((state |output_gate_s|)) (_ BitVec 32) (bvadd (|output_gate#51| state) #b00000000000000000000000000000001)) ; $add$output_gate.v:130$52_Y
(define-fun |output_gate#273| ((state |output_gate_s|)) Bool (and (or  (|output_gate#52| state) false) (or  (|output_gate#90| state) false))) ; $logic_and$output_gate.v:130$51_Y
(define-fun |output_gate#274| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#273| state) (|output_gate#272| state) (|output_gate#51| state))) ; $procmux$299_Y
(define-fun |output_gate#275| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#101| state) #b00000000000000000000000000000000 (|output_gate#274| state))) ; $0\emissions_q[31:0]
(define-fun |output_gate#276| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#30| state)) #b1) #b0 (ite (|output_gate#247| state) #b1 #b0))) ; $auto$rtlil.cc:3381:Mux$918
(define-fun |output_gate#277| ((state |output_gate_s|)) (_ BitVec 3) (bvand (concat ((_ extract 1 0) (|output_gate#26| state)) (ite (|output_gate#25| state) #b1 #b0)) (concat (ite (|output_gate#89| state) #b1 #b0) (concat (ite (|output_gate#89| state) #b1 #b0) (ite (|output_gate#89| state) #b1 #b0))))) ; $and$output_gate.v:127$49_Y
(define-fun |output_gate#278| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#101| state) #b000 (|output_gate#277| state))) ; $0\on_later_q[2:0]
(define-fun |output_gate#279| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#92| state) #b000 (|output_gate#10| state))) ; $procmux$354_Y
(define-fun |output_gate#280| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#103| state) #b100 (|output_gate#10| state))) ; $procmux$358_Y
(define-fun |output_gate#281| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#49| state) #b011 (|output_gate#10| state))) ; $procmux$361_Y
(define-fun |output_gate#282| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#92| state) #b010 (|output_gate#10| state))) ; $procmux$364_Y
(define-fun |output_gate#283| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#49| state) #b100 (|output_gate#282| state))) ; $procmux$367_Y
(define-fun |output_gate#284| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#102| state)) #b1) (= ((_ extract 1 1) (|output_gate#102| state)) #b1) (= ((_ extract 2 2) (|output_gate#102| state)) #b1) (= ((_ extract 3 3) (|output_gate#102| state)) #b1) (= ((_ extract 4 4) (|output_gate#102| state)) #b1) (= ((_ extract 5 5) (|output_gate#102| state)) #b1) (= ((_ extract 6 6) (|output_gate#102| state)) #b1) (= ((_ extract 7 7) (|output_gate#102| state)) #b1) (= ((_ extract 8 8) (|output_gate#102| state)) #b1) (= ((_ extract 9 9) (|output_gate#102| state)) #b1) (= ((_ extract 10 10) (|output_gate#102| state)) #b1) (= ((_ extract 11 11) (|output_gate#102| state)) #b1) (= ((_ extract 12 12) (|output_gate#102| state)) #b1) (= ((_ extract 13 13) (|output_gate#102| state)) #b1) (= ((_ extract 14 14) (|output_gate#102| state)) #b1) (= ((_ extract 15 15) (|output_gate#102| state)) #b1)))) ; $eq$output_gate.v:117$46_Y
(define-fun |output_gate#285| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#284| state) #b001 (|output_gate#10| state))) ; $procmux$370_Y
(define-fun |output_gate#286| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#49| state) #b000 (|output_gate#285| state))) ; $procmux$373_Y
(define-fun |output_gate#287| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#9| state) #b101 (|output_gate#10| state))) ; $procmux$376_Y
(define-fun |output_gate#288| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#53| state) (|output_gate#287| state) (ite (|output_gate#18| state) (|output_gate#286| state) (ite (|output_gate#19| state) (|output_gate#283| state) (ite (|output_gate#11| state) (|output_gate#281| state) (ite (|output_gate#21| state) (|output_gate#280| state) (ite (|output_gate#23| state) (|output_gate#279| state) #b000))))))) ; $procmux$356_Y
(define-fun |output_gate#289| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#87| state) #b000 (|output_gate#288| state))) ; $procmux$379_Y
(define-fun |output_gate#290| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#101| state) #b000 (|output_gate#289| state))) ; $0\state_q[2:0]
(define-fun |output_gate#291| ((state |output_gate_s|)) Bool (= (|output_gate#108| state) #b00000000000000000000000000000001)) ; $eq$output_gate.v:98$35_Y
(define-fun |output_gate#292| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#7| state)) #b1) #b1 (ite (|output_gate#291| state) #b1 #b0))) ; $procmux$339_Y
(define-fun |output_gate#293| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#63| state) #b0 (|output_gate#292| state))) ; $procmux$342_Y
(define-fun |output_gate#294| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#101| state) #b1 (|output_gate#293| state))) ; $0\silent_q[0:0]
(define-fun |output_gate#295| ((state |output_gate_s|)) (_ BitVec 32) (bvsub (|output_gate#6| state) #b00000000000000000000000000000001)) ; $sub$output_gate.v:136$59_Y
(define-fun |output_gate#296| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#248| state) #b00000000000000000000011111001111 (|output_gate#295| state))) ; $procmux$284_Y
(define-fun |output_gate#297| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#90| state) (|output_gate#296| state) #b00000000000000000000000000000000)) ; $procmux$287_Y
(define-fun |output_gate#298| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#101| state) #b00000000000000000000000000000000 (|output_gate#297| state))) ; $0\alive_left_q[31:0]
(define-fun |output_gate#299| ((state |output_gate_s|)) (_ BitVec 17) (bvadd (|output_gate#5| state) #b00000000000000001)) ; $add$output_gate_properties.vh:14$103_Y
(define-fun |output_gate#300| ((state |output_gate_s|)) (_ BitVec 17) (ite (|output_gate#209| state) #b01111010000100100 (|output_gate#299| state))) ; $0\longer$func$output_gate_properties.vh:37$1.$result[16:0]$97
(define-fun |output_gate#301| ((state |output_gate_s|)) Bool (not (or  (|output_gate#89| state) false))) ; $logic_not$output_gate_properties.vh:37$105_Y
(define-fun |output_gate#302| ((state |output_gate_s|)) Bool (or  (|output_gate#101| state) false  (|output_gate#301| state) false)) ; $logic_or$output_gate_properties.vh:37$106_Y
(define-fun |output_gate#303| ((state |output_gate_s|)) Bool (not (or  (|output_gate#25| state) false))) ; $logic_not$output_gate_properties.vh:37$107_Y
(define-fun |output_gate#304| ((state |output_gate_s|)) Bool (or  (|output_gate#302| state) false  (|output_gate#303| state) false)) ; $logic_or$output_gate_properties.vh:37$108_Y
(define-fun |output_gate#305| ((state |output_gate_s|)) (_ BitVec 17) (ite (|output_gate#304| state) #b00000000000000000 (|output_gate#300| state))) ; $0\age_q[16:0]
(define-fun |output_gate#306| ((state |output_gate_s|)) (_ BitVec 17) (ite (|output_gate#302| state) #b00000000000000000 (|output_gate#3| state))) ; $0\age_4_q[16:0]
(define-fun |output_gate#307| ((state |output_gate_s|)) (_ BitVec 17) (ite (|output_gate#302| state) #b00000000000000000 (|output_gate#2| state))) ; $0\age_3_q[16:0]
(define-fun |output_gate#308| ((state |output_gate_s|)) (_ BitVec 17) (ite (|output_gate#302| state) #b00000000000000000 (|output_gate#1| state))) ; $0\age_2_q[16:0]
(define-fun |output_gate#309| ((state |output_gate_s|)) (_ BitVec 17) (ite (|output_gate#302| state) #b00000000000000000 (|output_gate#5| state))) ; $0\age_1_q[16:0]
(define-fun |output_gate#310| ((state |output_gate_s|)) (_ BitVec 32) (bvand (|output_gate#50| state) (|output_gate#44| state))) ; $and$output_gate.v:165$64_Y
(define-fun |output_gate#311| ((state |output_gate_s|)) Bool (and (or  (|output_gate#90| state) false) (or  (= ((_ extract 2 2) (|output_gate#79| state)) #b1) false))) ; $logic_and$output_gate.v:165$61_Y
(define-fun |output_gate#312| ((state |output_gate_s|)) Bool (and (or  (|output_gate#311| state) false) (or  (|output_gate#246| state) false))) ; $logic_and$output_gate.v:165$63_Y
(define-fun |output_gate#313| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#312| state) (|output_gate#310| state) #b00000000000000000000000000000000)) ; $0\channel_q[31:0]
(define-fun |output_gate#314| ((state |output_gate_s|)) (_ BitVec 32) (ite (= ((_ extract 0 0) (|output_gate#30| state)) #b1) #b00000000000000000000000000000000 (|output_gate#313| state))) ; $auto$rtlil.cc:3381:Mux$920
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
))
(define-fun |output_gate_u| ((state |output_gate_s|)) Bool (and
  (|output_gate_u 0| state)
  (|output_gate_u 1| state)
  (|output_gate_u 2| state)
))
(define-fun |output_gate_i| ((state |output_gate_s|)) Bool 
  (= (= ((_ extract 0 0) (|output_gate#15| state)) #b1) false) ; started_q
)
(define-fun |output_gate_h| ((state |output_gate_s|)) Bool true)
(define-fun |output_gate_t| ((state |output_gate_s|) (next_state |output_gate_s|)) Bool (and
  (= (|output_gate#224| state) (|output_gate#115| next_state)) ; $procdff$746 \up_q
  (= (|output_gate#227| state) (|output_gate#114| next_state)) ; $procdff$710 \underruns_q
  (= (|output_gate#231| state) (|output_gate#108| next_state)) ; $procdff$704 \silence_q
  (= (|output_gate#7| state) (|output_gate#104| next_state)) ; $procdff$734 \silent_1_q
  (= (|output_gate#234| state) (|output_gate#102| next_state)) ; $procdff$712 \settle_left_q
  (= (|output_gate#239| state) (|output_gate#100| next_state)) ; $procdff$708 \resting_q
  (= (|output_gate#243| state) (|output_gate#99| next_state)) ; $procdff$707 \rest_left_q
  (= (|output_gate#100| state) (|output_gate#95| next_state)) ; $procdff$740 \resting_1_q
  (= (ite (|output_gate#33| state) #b1 #b0) (|output_gate#91| next_state)) ; $procdff$732 \permit_1_q
  (= (|output_gate#245| state) (|output_gate#79| next_state)) ; $procdff$714 \moves_later_q
  (= (|output_gate#44| state) (|output_gate#77| next_state)) ; $procdff$736 \mask_1_q
  (= (|output_gate#251| state) (|output_gate#73| next_state)) ; $procdff$729 \_witness_.anyinit_procdff_729
  (= (ite (|output_gate#101| state) #b1 #b0) (|output_gate#67| next_state)) ; $procdff$731 \rst_1_q
  (= (|output_gate#31| state) (|output_gate#66| next_state)) ; $procdff$739 \hv_1_q
  (= (|output_gate#255| state) (|output_gate#61| next_state)) ; $procdff$726 \_witness_.anyinit_procdff_726
  (= (|output_gate#261| state) (|output_gate#60| next_state)) ; $procdff$715 \focus_left_q
  (= ((_ extract 8 4) (|output_gate#57| state)) (|output_gate#59| next_state)) ; $procdff$738 \faults_1_q
  (= (|output_gate#263| state) (|output_gate#58| next_state)) ; $procdff$711 \fault_time_q
  (= (|output_gate#267| state) (|output_gate#57| next_state)) ; $procdff$706 \fault_q
  (= (|output_gate#270| state) (|output_gate#56| next_state)) ; $procdff$709 \fault_count_q
  (= (ite (|output_gate#271| state) #b1 #b0) (|output_gate#55| next_state)) ; $procdff$735 \exists_1_q
  (= (|output_gate#275| state) (|output_gate#51| next_state)) ; $procdff$716 \emissions_q
  (= (ite (|output_gate#37| state) #b1 #b0) (|output_gate#48| next_state)) ; $procdff$733 \cool_1_q
  (= (|output_gate#276| state) (|output_gate#29| next_state)) ; $procdff$723 \_witness_.anyinit_procdff_723
  (= (|output_gate#278| state) (|output_gate#26| next_state)) ; $procdff$713 \on_later_q
  (= #b1 (|output_gate#15| next_state)) ; $procdff$730 \started_q
  (= (|output_gate#42| state) (|output_gate#12| next_state)) ; $procdff$737 \limits_1_q
  (= (|output_gate#290| state) (|output_gate#10| next_state)) ; $procdff$703 \state_q
  (= (|output_gate#294| state) (|output_gate#7| next_state)) ; $procdff$705 \silent_q
  (= (|output_gate#298| state) (|output_gate#6| next_state)) ; $procdff$717 \alive_left_q
  (= (|output_gate#305| state) (|output_gate#5| next_state)) ; $procdff$741 \age_q
  (= (|output_gate#306| state) (|output_gate#4| next_state)) ; $procdff$745 \age_4_q
  (= (|output_gate#307| state) (|output_gate#3| next_state)) ; $procdff$744 \age_3_q
  (= (|output_gate#308| state) (|output_gate#2| next_state)) ; $procdff$743 \age_2_q
  (= (|output_gate#309| state) (|output_gate#1| next_state)) ; $procdff$742 \age_1_q
  (= (|output_gate#314| state) (|output_gate#0| next_state)) ; $procdff$720 \_witness_.anyinit_procdff_720
)) ; end of module output_gate
