; of b0341b5e6528ec6a7778334775df558435dec0413da4cd90c1deee68506af172, by python -m tests.rtl.proofs
(declare-sort |output_gate_s| 0)
(declare-fun |output_gate_is| (|output_gate_s|) Bool)
(declare-fun |output_gate#0| (|output_gate_s|) (_ BitVec 32)) ; \_witness_.anyinit_procdff_1007
(define-fun |output_gate_n _witness_.anyinit_procdff_1007| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#0| state))
(declare-fun |output_gate#1| (|output_gate_s|) (_ BitVec 1)) ; \shut_1_q
(declare-fun |output_gate#2| (|output_gate_s|) (_ BitVec 16)) ; \all_faults_1_q
(define-fun |output_gate#3| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#2| state)) #b1) (= ((_ extract 1 1) (|output_gate#2| state)) #b1) (= ((_ extract 2 2) (|output_gate#2| state)) #b1) (= ((_ extract 3 3) (|output_gate#2| state)) #b1) (= ((_ extract 4 4) (|output_gate#2| state)) #b1) (= ((_ extract 5 5) (|output_gate#2| state)) #b1) (= ((_ extract 6 6) (|output_gate#2| state)) #b1) (= ((_ extract 7 7) (|output_gate#2| state)) #b1) (= ((_ extract 8 8) (|output_gate#2| state)) #b1) (= ((_ extract 9 9) (|output_gate#2| state)) #b1) (= ((_ extract 10 10) (|output_gate#2| state)) #b1) (= ((_ extract 11 11) (|output_gate#2| state)) #b1) (= ((_ extract 12 12) (|output_gate#2| state)) #b1) (= ((_ extract 13 13) (|output_gate#2| state)) #b1) (= ((_ extract 14 14) (|output_gate#2| state)) #b1) (= ((_ extract 15 15) (|output_gate#2| state)) #b1)))) ; $eq$output_gate_properties.vh:105$242_Y
(define-fun |output_gate#4| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 0 0) (|output_gate#1| state)) #b1) false) (or  (|output_gate#3| state) false))) ; $logic_and$output_gate_properties.vh:105$243_Y
(define-fun |output_gate#5| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#4| state) #b1 #b0)) ; $procmux$896_Y
(declare-fun |output_gate#6| (|output_gate_s|) (_ BitVec 1)) ; \rst_1_q
(define-fun |output_gate#7| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#6| state)) #b1) #b0 (|output_gate#5| state))) ; $procmux$898_Y
(declare-fun |output_gate#8| (|output_gate_s|) (_ BitVec 1)) ; \started_q
(define-fun |output_gate#9| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#7| state) #b0)) ; \a_fault_is_counted_EN
(define-fun |output_gate_n a_fault_is_counted_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#9| state)) #b1))
(declare-fun |output_gate#10| (|output_gate_s|) (_ BitVec 32)) ; \since_limit_q
(define-fun |output_gate#11| ((state |output_gate_s|)) Bool (bvult (|output_gate#10| state) #b00000000111011100110101100101000)) ; $lt$output_gate_properties.vh:116$272_Y
(define-fun |output_gate#12| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#11| state) #b1 #b0)) ; $procmux$848_Y
(define-fun |output_gate#13| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#12| state) #b0)) ; \a_limit_rests_EN
(define-fun |output_gate_n a_limit_rests_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#13| state)) #b1))
(declare-fun |output_gate#14| (|output_gate_s|) (_ BitVec 17)) ; \age_1_q
(define-fun |output_gate_n age_1_q| ((state |output_gate_s|)) (_ BitVec 17) (|output_gate#14| state))
(declare-fun |output_gate#15| (|output_gate_s|) (_ BitVec 17)) ; \age_2_q
(define-fun |output_gate_n age_2_q| ((state |output_gate_s|)) (_ BitVec 17) (|output_gate#15| state))
(declare-fun |output_gate#16| (|output_gate_s|) (_ BitVec 17)) ; \age_3_q
(define-fun |output_gate_n age_3_q| ((state |output_gate_s|)) (_ BitVec 17) (|output_gate#16| state))
(declare-fun |output_gate#17| (|output_gate_s|) (_ BitVec 17)) ; \age_4_q
(define-fun |output_gate_n age_4_q| ((state |output_gate_s|)) (_ BitVec 17) (|output_gate#17| state))
(declare-fun |output_gate#18| (|output_gate_s|) (_ BitVec 17)) ; \age_q
(define-fun |output_gate_n age_q| ((state |output_gate_s|)) (_ BitVec 17) (|output_gate#18| state))
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
(define-fun |output_gate#25| ((state |output_gate_s|)) Bool (distinct (|output_gate#24| state) #b00000000000000000000000000000000)) ; $ne$output_gate_properties.vh:141$363_Y
(declare-fun |output_gate#26| (|output_gate_s|) (_ BitVec 1)) ; \_witness_.anyinit_procdff_1010
(define-fun |output_gate#27| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#23| state)) #b1) #b0 (|output_gate#26| state))) ; \hv_enable_q
(define-fun |output_gate#28| ((state |output_gate_s|)) Bool (or  (|output_gate#25| state) false  (= ((_ extract 0 0) (|output_gate#27| state)) #b1) false)) ; $logic_or$output_gate_properties.vh:78$181_Y
(declare-fun |output_gate#29| (|output_gate_s|) (_ BitVec 1)) ; \_witness_.anyinit_procdff_1016
(define-fun |output_gate#30| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#23| state)) #b1) #b0 (|output_gate#29| state))) ; \hv_alive_q
(define-fun |output_gate#31| ((state |output_gate_s|)) Bool (or  (|output_gate#28| state) false  (= ((_ extract 0 0) (|output_gate#30| state)) #b1) false)) ; $logic_or$output_gate_properties.vh:78$182_Y
(declare-fun |output_gate#32| (|output_gate_s|) (_ BitVec 1)) ; \_witness_.anyinit_procdff_1013
(define-fun |output_gate#33| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#23| state)) #b1) #b0 (|output_gate#32| state))) ; \focus_q
(define-fun |output_gate#34| ((state |output_gate_s|)) Bool (or  (|output_gate#31| state) false  (= ((_ extract 0 0) (|output_gate#33| state)) #b1) false)) ; \any
(define-fun |output_gate_n any| ((state |output_gate_s|)) Bool (|output_gate#34| state))
(define-fun |output_gate#35| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#23| state)) #b1) #b0 #b1)) ; $procmux$789_Y
(define-fun |output_gate#36| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#35| state) #b0)) ; \any_is_known_EN
(define-fun |output_gate_n any_is_known_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#36| state)) #b1))
(declare-fun |output_gate#37| (|output_gate_s|) (_ BitVec 1)) ; \arm_1_q
(define-fun |output_gate_n arm_1_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#37| state)) #b1))
(declare-fun |output_gate#38| (|output_gate_s|) Bool) ; \arm_i
(define-fun |output_gate_n arm_i| ((state |output_gate_s|)) Bool (|output_gate#38| state))
(declare-fun |output_gate#39| (|output_gate_s|) (_ BitVec 3)) ; \state_q
(define-fun |output_gate#40| ((state |output_gate_s|)) Bool (= (|output_gate#39| state) #b010)) ; \armed_o
(define-fun |output_gate_n armed_o| ((state |output_gate_s|)) Bool (|output_gate#40| state))
(declare-fun |output_gate#41| (|output_gate_s|) (_ BitVec 5)) ; \limits_1_q
(define-fun |output_gate#42| ((state |output_gate_s|)) Bool (distinct (|output_gate#41| state) #b00000)) ; $ne$output_gate_properties.vh:86$213_Y
(define-fun |output_gate#43| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#42| state) #b1 #b0)) ; $procmux$964_Y
(define-fun |output_gate#44| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#43| state) #b0)) ; \beyond_is_off_EN
(define-fun |output_gate_n beyond_is_off_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#44| state)) #b1))
(declare-fun |output_gate#45| (|output_gate_s|) (_ BitVec 16)) ; \bit_ticks_i
(define-fun |output_gate_n bit_ticks_i| ((state |output_gate_s|)) (_ BitVec 16) (|output_gate#45| state))
(declare-fun |output_gate#46| (|output_gate_s|) Bool) ; \run_permit_i
(define-fun |output_gate#47| ((state |output_gate_s|)) Bool (not (or  (|output_gate#46| state) false))) ; \wrong [0]
(declare-fun |output_gate#48| (|output_gate_s|) Bool) ; \temperature_good_i
(define-fun |output_gate#49| ((state |output_gate_s|)) Bool (not (or  (|output_gate#48| state) false))) ; \wrong [2]
(declare-fun |output_gate#50| (|output_gate_s|) (_ BitVec 6)) ; { \limits_i \underrun_i }
(declare-fun |output_gate#51| (|output_gate_s|) (_ BitVec 1)) ; \live_q
(define-fun |output_gate#52| ((state |output_gate_s|)) (_ BitVec 9) (bvand (concat (|output_gate#50| state) (concat (ite (|output_gate#49| state) #b1 #b0) (concat (|output_gate#20| state) (ite (|output_gate#47| state) #b1 #b0)))) (concat (|output_gate#51| state) (concat (|output_gate#51| state) (concat #b11 (concat (|output_gate#51| state) (concat (|output_gate#51| state) (concat (|output_gate#51| state) (concat (|output_gate#51| state) (|output_gate#51| state)))))))))) ; \cause
(define-fun |output_gate_n cause| ((state |output_gate_s|)) (_ BitVec 9) (|output_gate#52| state))
(declare-fun |output_gate#53| (|output_gate_s|) (_ BitVec 32)) ; \channel_mask_i
(define-fun |output_gate_n channel_mask_i| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#53| state))
(define-fun |output_gate_n channel_o| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#24| state))
(define-fun |output_gate_n channel_q| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#24| state))
(declare-fun |output_gate#54| (|output_gate_s|) (_ BitVec 1)) ; \clear_1_q
(define-fun |output_gate_n clear_1_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#54| state)) #b1))
(declare-fun |output_gate#55| (|output_gate_s|) Bool) ; \clear_i
(define-fun |output_gate_n clear_i| ((state |output_gate_s|)) Bool (|output_gate#55| state))
(declare-fun |output_gate#56| (|output_gate_s|) Bool) ; \clk_i
(define-fun |output_gate_n clk_i| ((state |output_gate_s|)) Bool (|output_gate#56| state))
(define-fun |output_gate_n clock_lost_i| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#23| state)) #b1))
(declare-fun |output_gate#57| (|output_gate_s|) (_ BitVec 1)) ; \cool_1_q
(define-fun |output_gate_n cool_1_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#57| state)) #b1))
(define-fun |output_gate#58| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#4| state) #b0 #b1)) ; $procmux$888_Y
(define-fun |output_gate#59| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#6| state)) #b1) #b0 (|output_gate#58| state))) ; $procmux$890_Y
(define-fun |output_gate#60| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#59| state) #b0)) ; \counted_once_EN
(define-fun |output_gate_n counted_once_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#60| state)) #b1))
(declare-fun |output_gate#61| (|output_gate_s|) (_ BitVec 1)) ; \disarm_1_q
(define-fun |output_gate_n disarm_1_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#61| state)) #b1))
(declare-fun |output_gate#62| (|output_gate_s|) Bool) ; \disarm_i
(define-fun |output_gate_n disarm_i| ((state |output_gate_s|)) Bool (|output_gate#62| state))
(define-fun |output_gate#63| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#37| state)) #b1) false))) ; $logic_not$output_gate_properties.vh:108$254_Y
(define-fun |output_gate#64| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 0 0) (|output_gate#61| state)) #b1) false) (or  (|output_gate#63| state) false))) ; $logic_and$output_gate_properties.vh:108$255_Y
(define-fun |output_gate#65| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#64| state) #b1 #b0)) ; $procmux$873_Y
(define-fun |output_gate#66| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#6| state)) #b1) #b0 (|output_gate#65| state))) ; $procmux$875_Y
(define-fun |output_gate#67| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#66| state) #b0)) ; \disarm_is_obeyed_EN
(define-fun |output_gate_n disarm_is_obeyed_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#67| state)) #b1))
(declare-fun |output_gate#68| (|output_gate_s|) (_ BitVec 1)) ; \disarmed_q
(define-fun |output_gate#69| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#68| state)) #b1) #b1 #b0)) ; $procmux$858_Y
(define-fun |output_gate#70| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#69| state) #b0)) ; \disarmed_for_good_EN
(define-fun |output_gate_n disarmed_for_good_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#70| state)) #b1))
(define-fun |output_gate_n disarmed_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#68| state)) #b1))
(declare-fun |output_gate#71| (|output_gate_s|) (_ BitVec 32)) ; \drive_1_q
(define-fun |output_gate_n drive_1_q| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#71| state))
(declare-fun |output_gate#72| (|output_gate_s|) (_ BitVec 32)) ; \drive_i
(define-fun |output_gate_n drive_i| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#72| state))
(define-fun |output_gate_n edges| ((state |output_gate_s|)) (_ BitVec 3) (concat ((_ extract 3 2) (|output_gate#50| state)) #b0))
(declare-fun |output_gate#73| (|output_gate_s|) (_ BitVec 5)) ; \edges_1_q
(define-fun |output_gate_n edges_1_q| ((state |output_gate_s|)) (_ BitVec 5) (|output_gate#73| state))
(define-fun |output_gate#74| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#6| state)) #b1) #b0 #b1)) ; $procmux$903_Y
(define-fun |output_gate#75| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#74| state) #b0)) ; \edges_are_kept_EN
(define-fun |output_gate_n edges_are_kept_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#75| state)) #b1))
(define-fun |output_gate#76| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#25| state) #b1 #b0)) ; $procmux$709_Y
(define-fun |output_gate#77| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#23| state)) #b1) #b0 (|output_gate#76| state))) ; $procmux$711_Y
(define-fun |output_gate#78| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#77| state) #b0)) ; \edges_once_settled_EN
(define-fun |output_gate_n edges_once_settled_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#78| state)) #b1))
(declare-fun |output_gate#79| (|output_gate_s|) (_ BitVec 32)) ; \emissions_q
(define-fun |output_gate_n emissions_o| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#79| state))
(define-fun |output_gate_n emissions_q| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#79| state))
(declare-fun |output_gate#80| (|output_gate_s|) Bool) ; \ended_i
(define-fun |output_gate_n ended_i| ((state |output_gate_s|)) Bool (|output_gate#80| state))
(define-fun |output_gate#81| ((state |output_gate_s|)) Bool (= (|output_gate#39| state) #b101)) ; \settling
(define-fun |output_gate#82| ((state |output_gate_s|)) Bool (= (|output_gate#39| state) #b001)) ; \ramp_up_o
(define-fun |output_gate#83| ((state |output_gate_s|)) Bool (or  (|output_gate#82| state) false  (|output_gate#40| state) false)) ; $logic_or$output_gate.v:84$10_Y
(define-fun |output_gate#84| ((state |output_gate_s|)) Bool (= (|output_gate#39| state) #b011)) ; \stopping_o
(define-fun |output_gate#85| ((state |output_gate_s|)) Bool (or  (|output_gate#83| state) false  (|output_gate#84| state) false)) ; $logic_or$output_gate.v:84$12_Y
(define-fun |output_gate#86| ((state |output_gate_s|)) Bool (= (|output_gate#39| state) #b100)) ; \ramp_down_o
(define-fun |output_gate#87| ((state |output_gate_s|)) Bool (or  (|output_gate#85| state) false  (|output_gate#86| state) false)) ; \moves
(define-fun |output_gate#88| ((state |output_gate_s|)) Bool (or  (|output_gate#81| state) false  (|output_gate#87| state) false)) ; \on
(define-fun |output_gate#89| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#39| state)) #b1) (= ((_ extract 1 1) (|output_gate#39| state)) #b1) (= ((_ extract 2 2) (|output_gate#39| state)) #b1)))) ; \off_o
(define-fun |output_gate#90| ((state |output_gate_s|)) Bool (or  (|output_gate#88| state) false  (|output_gate#89| state) false)) ; \exists
(define-fun |output_gate_n exists| ((state |output_gate_s|)) Bool (|output_gate#90| state))
(declare-fun |output_gate#91| (|output_gate_s|) (_ BitVec 1)) ; \exists_1_q
(define-fun |output_gate_n exists_1_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#91| state)) #b1))
(declare-fun |output_gate#92| (|output_gate_s|) (_ BitVec 32)) ; \fault_count_1_q
(define-fun |output_gate_n fault_count_1_q| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#92| state))
(declare-fun |output_gate#93| (|output_gate_s|) (_ BitVec 32)) ; \fault_count_q
(define-fun |output_gate_n fault_count_o| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#93| state))
(define-fun |output_gate_n fault_count_q| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#93| state))
(declare-fun |output_gate#94| (|output_gate_s|) (_ BitVec 9)) ; \fault_q
(define-fun |output_gate_n fault_o| ((state |output_gate_s|)) (_ BitVec 16) (concat #b0000000 (|output_gate#94| state)))
(define-fun |output_gate_n fault_q| ((state |output_gate_s|)) (_ BitVec 9) (|output_gate#94| state))
(declare-fun |output_gate#95| (|output_gate_s|) (_ BitVec 64)) ; \fault_time_q
(define-fun |output_gate_n fault_time_o| ((state |output_gate_s|)) (_ BitVec 64) (|output_gate#95| state))
(define-fun |output_gate_n fault_time_q| ((state |output_gate_s|)) (_ BitVec 64) (|output_gate#95| state))
(declare-fun |output_gate#96| (|output_gate_s|) (_ BitVec 1)) ; \faulted_q
(define-fun |output_gate_n faulted_o| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#96| state)) #b1))
(define-fun |output_gate_n faulted_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#96| state)) #b1))
(declare-fun |output_gate#97| (|output_gate_s|) (_ BitVec 5)) ; \faults_1_q
(define-fun |output_gate_n faults_1_q| ((state |output_gate_s|)) (_ BitVec 5) (|output_gate#97| state))
(declare-fun |output_gate#98| (|output_gate_s|) (_ BitVec 1)) ; \fed_q
(define-fun |output_gate_n fed_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#98| state)) #b1))
(declare-fun |output_gate#99| (|output_gate_s|) (_ BitVec 32)) ; \fed_ticks_q
(define-fun |output_gate_n fed_ticks_q| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#99| state))
(declare-fun |output_gate#100| (|output_gate_s|) (_ BitVec 16)) ; \focus_left_q
(define-fun |output_gate_n focus_left_q| ((state |output_gate_s|)) (_ BitVec 16) (|output_gate#100| state))
(define-fun |output_gate_n focus_o| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#33| state)) #b1))
(define-fun |output_gate_n focus_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#33| state)) #b1))
(declare-fun |output_gate#101| (|output_gate_s|) Bool) ; \heartbeat_i
(define-fun |output_gate_n heartbeat_i| ((state |output_gate_s|)) Bool (|output_gate#101| state))
(declare-fun |output_gate#102| (|output_gate_s|) (_ BitVec 32)) ; \heartbeat_ticks_i
(define-fun |output_gate_n heartbeat_ticks_i| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#102| state))
(define-fun |output_gate#103| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#57| state)) #b1) #b0 #b1)) ; $procmux$934_Y
(declare-fun |output_gate#104| (|output_gate_s|) (_ BitVec 1)) ; \hv_1_q
(define-fun |output_gate#105| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#6| state)) #b1) false))) ; $logic_not$output_gate_properties.vh:117$274_Y
(define-fun |output_gate#106| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 0 0) (|output_gate#104| state)) #b1) false) (or  (|output_gate#105| state) false))) ; $logic_and$output_gate_properties.vh:94$225_Y
(define-fun |output_gate#107| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#106| state) (|output_gate#103| state) #b0)) ; $procmux$936_Y
(define-fun |output_gate#108| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#107| state) #b0)) ; \heat_is_kept_EN
(define-fun |output_gate_n heat_is_kept_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#108| state)) #b1))
(define-fun |output_gate#109| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#103| state) #b0)) ; \hot_is_off_EN
(define-fun |output_gate_n hot_is_off_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#109| state)) #b1))
(define-fun |output_gate_n hv_1_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#104| state)) #b1))
(define-fun |output_gate_n hv_alive_o| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#30| state)) #b1))
(define-fun |output_gate_n hv_alive_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#30| state)) #b1))
(define-fun |output_gate_n hv_enable_o| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#27| state)) #b1))
(define-fun |output_gate_n hv_enable_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#27| state)) #b1))
(define-fun |output_gate_n limits_1_q| ((state |output_gate_s|)) (_ BitVec 5) (|output_gate#41| state))
(define-fun |output_gate#110| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#106| state) #b1 #b0)) ; $procmux$922_Y
(define-fun |output_gate#111| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#110| state) #b0)) ; \limits_are_kept_EN
(define-fun |output_gate_n limits_are_kept_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#111| state)) #b1))
(define-fun |output_gate_n limits_i| ((state |output_gate_s|)) (_ BitVec 5) ((_ extract 5 1) (|output_gate#50| state)))
(define-fun |output_gate_n live_is_anything_on_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#36| state)) #b1))
(define-fun |output_gate_n live_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#51| state)) #b1))
(define-fun |output_gate_n _witness_.anyinit_procdff_1010| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#26| state)) #b1))
(define-fun |output_gate_n _witness_.anyinit_procdff_1013| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#32| state)) #b1))
(define-fun |output_gate_n _witness_.anyinit_procdff_1016| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#29| state)) #b1))
(declare-fun |output_gate#112| (|output_gate_s|) (_ BitVec 32)) ; \mask_1_q
(define-fun |output_gate_n mask_1_q| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#112| state))
(define-fun |output_gate#113| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) #b1 #b0)) ; \mask_is_kept_EN
(define-fun |output_gate_n mask_is_kept_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#113| state)) #b1))
(define-fun |output_gate_n moves| ((state |output_gate_s|)) Bool (|output_gate#87| state))
(declare-fun |output_gate#114| (|output_gate_s|) (_ BitVec 3)) ; \moves_later_q
(define-fun |output_gate_n moves_later_q| ((state |output_gate_s|)) (_ BitVec 3) (|output_gate#114| state))
(define-fun |output_gate#115| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#87| state) #b1 #b0)) ; $procmux$741_Y
(define-fun |output_gate#116| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#23| state)) #b1) #b0 (|output_gate#115| state))) ; $procmux$743_Y
(define-fun |output_gate#117| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#116| state) #b0)) ; \moves_once_settled_EN
(define-fun |output_gate_n moves_once_settled_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#117| state)) #b1))
(define-fun |output_gate_n no_channel_alone_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#113| state)) #b1))
(define-fun |output_gate#118| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#23| state)) #b1) #b1 #b0)) ; \no_clock_is_off_EN
(define-fun |output_gate_n no_clock_is_off_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#118| state)) #b1))
(define-fun |output_gate_n no_sign_of_life_alone_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#113| state)) #b1))
(define-fun |output_gate#119| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#91| state)) #b1) #b0 #b1)) ; $procmux$954_Y
(define-fun |output_gate#120| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#119| state) #b0)) ; \nonsense_is_off_EN
(define-fun |output_gate_n nonsense_is_off_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#120| state)) #b1))
(declare-fun |output_gate#121| (|output_gate_s|) (_ BitVec 64)) ; \now_1_q
(define-fun |output_gate_n now_1_q| ((state |output_gate_s|)) (_ BitVec 64) (|output_gate#121| state))
(declare-fun |output_gate#122| (|output_gate_s|) (_ BitVec 64)) ; \now_i
(define-fun |output_gate_n now_i| ((state |output_gate_s|)) (_ BitVec 64) (|output_gate#122| state))
(define-fun |output_gate_n off_o| ((state |output_gate_s|)) Bool (|output_gate#89| state))
(define-fun |output_gate_n on| ((state |output_gate_s|)) Bool (|output_gate#88| state))
(declare-fun |output_gate#123| (|output_gate_s|) (_ BitVec 3)) ; \on_later_q
(define-fun |output_gate_n on_later_q| ((state |output_gate_s|)) (_ BitVec 3) (|output_gate#123| state))
(define-fun |output_gate#124| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#34| state) #b1 #b0)) ; $procmux$853_Y
(define-fun |output_gate#125| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#124| state) #b0)) ; \on_once_armed_EN
(define-fun |output_gate_n on_once_armed_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#125| state)) #b1))
(define-fun |output_gate_n on_while_fed_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#125| state)) #b1))
(define-fun |output_gate_n on_without_fault_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#125| state)) #b1))
(define-fun |output_gate#126| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#1| state)) #b1) #b0 #b1)) ; $procmux$880_Y
(define-fun |output_gate#127| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#6| state)) #b1) #b0 (|output_gate#126| state))) ; $procmux$882_Y
(define-fun |output_gate#128| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#127| state) #b0)) ; \only_a_cause_is_kept_EN
(define-fun |output_gate_n only_a_cause_is_kept_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#128| state)) #b1))
(define-fun |output_gate#129| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#54| state)) #b1) #b0 #b1)) ; $procmux$908_Y
(define-fun |output_gate#130| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#6| state)) #b1) #b0 (|output_gate#129| state))) ; $procmux$910_Y
(define-fun |output_gate#131| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#130| state) #b0)) ; \only_a_command_clears_EN
(define-fun |output_gate_n only_a_command_clears_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#131| state)) #b1))
(define-fun |output_gate_n only_what_is_played_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#113| state)) #b1))
(define-fun |output_gate#132| ((state |output_gate_s|)) Bool (not (or  (|output_gate#47| state) (= ((_ extract 0 0) (|output_gate#20| state)) #b1) (|output_gate#49| state) (= ((_ extract 0 0) (|output_gate#50| state)) #b1) (= ((_ extract 1 1) (|output_gate#50| state)) #b1) (= ((_ extract 2 2) (|output_gate#50| state)) #b1) (= ((_ extract 3 3) (|output_gate#50| state)) #b1) (= ((_ extract 4 4) (|output_gate#50| state)) #b1) (= ((_ extract 5 5) (|output_gate#50| state)) #b1)))) ; $eq$output_gate.v:95$23_Y
(define-fun |output_gate#133| ((state |output_gate_s|)) Bool (and (or  (|output_gate#90| state) false) (or  (|output_gate#132| state) false))) ; \stays
(define-fun |output_gate#134| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 2 2) (|output_gate#123| state)) #b1) false) (or  (|output_gate#133| state) false))) ; \open
(define-fun |output_gate_n open| ((state |output_gate_s|)) Bool (|output_gate#134| state))
(declare-fun |output_gate#135| (|output_gate_s|) (_ BitVec 1)) ; \permit_1_q
(define-fun |output_gate_n permit_1_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#135| state)) #b1))
(declare-fun |output_gate#136| (|output_gate_s|) Bool) ; \ramp_done_i
(define-fun |output_gate_n ramp_done_i| ((state |output_gate_s|)) Bool (|output_gate#136| state))
(define-fun |output_gate_n ramp_down_o| ((state |output_gate_s|)) Bool (|output_gate#86| state))
(define-fun |output_gate_n ramp_up_o| ((state |output_gate_s|)) Bool (|output_gate#82| state))
(define-fun |output_gate#137| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#6| state)) #b1) #b1 #b0)) ; $procmux$984_Y
(define-fun |output_gate#138| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#137| state) #b0)) ; \reset_is_off_EN
(define-fun |output_gate_n reset_is_off_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#138| state)) #b1))
(define-fun |output_gate_n rest_has_its_time_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#36| state)) #b1))
(declare-fun |output_gate#139| (|output_gate_s|) (_ BitVec 1)) ; \resting_q
(define-fun |output_gate#140| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#139| state)) #b1) #b1 #b0)) ; $procmux$809_Y
(define-fun |output_gate#141| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#23| state)) #b1) #b0 (|output_gate#140| state))) ; $procmux$811_Y
(define-fun |output_gate#142| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#141| state) #b0)) ; \rest_is_counted_EN
(define-fun |output_gate_n rest_is_counted_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#142| state)) #b1))
(declare-fun |output_gate#143| (|output_gate_s|) (_ BitVec 1)) ; \resting_1_q
(define-fun |output_gate#144| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 0 0) (|output_gate#143| state)) #b1) false) (or  (|output_gate#105| state) false))) ; $logic_and$output_gate_properties.vh:117$275_Y
(define-fun |output_gate#145| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#144| state) #b1 #b0)) ; $procmux$843_Y
(define-fun |output_gate#146| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#145| state) #b0)) ; \rest_is_kept_EN
(define-fun |output_gate_n rest_is_kept_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#146| state)) #b1))
(declare-fun |output_gate#147| (|output_gate_s|) (_ BitVec 32)) ; \rest_left_q
(define-fun |output_gate_n rest_left_q| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#147| state))
(define-fun |output_gate_n resting_1_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#143| state)) #b1))
(define-fun |output_gate_n resting_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#139| state)) #b1))
(define-fun |output_gate#148| ((state |output_gate_s|)) (_ BitVec 9) (bvand (concat ((_ extract 8 4) (|output_gate#94| state)) #b0000) (concat (|output_gate#139| state) (concat (|output_gate#139| state) (concat (|output_gate#139| state) (concat (|output_gate#139| state) (concat (|output_gate#139| state) (concat (|output_gate#139| state) (concat (|output_gate#139| state) (concat (|output_gate#139| state) (|output_gate#139| state))))))))))) ; \rests
(define-fun |output_gate_n rests| ((state |output_gate_s|)) (_ BitVec 9) (|output_gate#148| state))
(define-fun |output_gate_n rst_1_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#6| state)) #b1))
(declare-fun |output_gate#149| (|output_gate_s|) Bool) ; \rst_i
(define-fun |output_gate_n rst_i| ((state |output_gate_s|)) Bool (|output_gate#149| state))
(define-fun |output_gate_n run_permit_i| ((state |output_gate_s|)) Bool (|output_gate#46| state))
(declare-fun |output_gate#150| (|output_gate_s|) (_ BitVec 16)) ; \settle_left_q
(define-fun |output_gate_n settle_left_q| ((state |output_gate_s|)) (_ BitVec 16) (|output_gate#150| state))
(declare-fun |output_gate#151| (|output_gate_s|) Bool) ; \settled_i
(define-fun |output_gate_n settled_i| ((state |output_gate_s|)) Bool (|output_gate#151| state))
(define-fun |output_gate_n settling| ((state |output_gate_s|)) Bool (|output_gate#81| state))
(define-fun |output_gate#152| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#81| state) #b1 #b0)) ; $procmux$749_Y
(define-fun |output_gate#153| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#23| state)) #b1) #b0 (|output_gate#152| state))) ; $procmux$751_Y
(define-fun |output_gate#154| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#153| state) #b0)) ; \settling_is_counted_EN
(define-fun |output_gate_n settling_is_counted_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#154| state)) #b1))
(define-fun |output_gate_n settling_o| ((state |output_gate_s|)) Bool (|output_gate#81| state))
(define-fun |output_gate#155| ((state |output_gate_s|)) Bool (distinct (|output_gate#52| state) #b000000000)) ; \shut
(define-fun |output_gate_n shut| ((state |output_gate_s|)) Bool (|output_gate#155| state))
(define-fun |output_gate_n shut_1_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#1| state)) #b1))
(define-fun |output_gate_n shut_o| ((state |output_gate_s|)) Bool (|output_gate#155| state))
(define-fun |output_gate#156| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#20| state)) #b1) #b0 #b1)) ; $procmux$765_Y
(define-fun |output_gate#157| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#23| state)) #b1) #b0 (|output_gate#156| state))) ; $procmux$767_Y
(define-fun |output_gate#158| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#157| state) #b0)) ; \silence_is_counted_EN
(define-fun |output_gate_n silence_is_counted_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#158| state)) #b1))
(declare-fun |output_gate#159| (|output_gate_s|) (_ BitVec 1)) ; \silent_1_q
(define-fun |output_gate#160| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#159| state)) #b1) #b1 #b0)) ; $procmux$927_Y
(define-fun |output_gate#161| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#106| state) (|output_gate#160| state) #b0)) ; $procmux$929_Y
(define-fun |output_gate#162| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#161| state) #b0)) ; \silence_is_kept_EN
(define-fun |output_gate_n silence_is_kept_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#162| state)) #b1))
(declare-fun |output_gate#163| (|output_gate_s|) (_ BitVec 32)) ; \silence_q
(define-fun |output_gate_n silence_q| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#163| state))
(define-fun |output_gate_n silent_1_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#159| state)) #b1))
(define-fun |output_gate_n silent_in_time_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#158| state)) #b1))
(define-fun |output_gate#164| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#160| state) #b0)) ; \silent_is_off_EN
(define-fun |output_gate_n silent_is_off_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#164| state)) #b1))
(define-fun |output_gate_n silent_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#20| state)) #b1))
(define-fun |output_gate_n since_limit_q| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#10| state))
(define-fun |output_gate_n started_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#8| state)) #b1))
(define-fun |output_gate_n state_q| ((state |output_gate_s|)) (_ BitVec 3) (|output_gate#39| state))
(define-fun |output_gate_n stays| ((state |output_gate_s|)) Bool (|output_gate#133| state))
(define-fun |output_gate#165| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#135| state)) #b1) #b0 #b1)) ; $procmux$941_Y
(define-fun |output_gate#166| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#106| state) (|output_gate#165| state) #b0)) ; $procmux$943_Y
(define-fun |output_gate#167| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#166| state) #b0)) ; \stop_is_kept_EN
(define-fun |output_gate_n stop_is_kept_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#167| state)) #b1))
(define-fun |output_gate#168| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#165| state) #b0)) ; \stopped_is_off_EN
(define-fun |output_gate_n stopped_is_off_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#168| state)) #b1))
(define-fun |output_gate_n stopping_o| ((state |output_gate_s|)) Bool (|output_gate#84| state))
(define-fun |output_gate_n supply_has_settled_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#113| state)) #b1))
(define-fun |output_gate_n temperature_good_i| ((state |output_gate_s|)) Bool (|output_gate#48| state))
(declare-fun |output_gate#169| (|output_gate_s|) (_ BitVec 1)) ; \underrun_1_q
(define-fun |output_gate_n underrun_1_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#169| state)) #b1))
(define-fun |output_gate_n underrun_i| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#50| state)) #b1))
(define-fun |output_gate#170| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#169| state)) #b1) #b1 #b0)) ; $procmux$915_Y
(define-fun |output_gate#171| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#106| state) (|output_gate#170| state) #b0)) ; $procmux$917_Y
(define-fun |output_gate#172| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#171| state) #b0)) ; \underrun_is_kept_EN
(define-fun |output_gate_n underrun_is_kept_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#172| state)) #b1))
(define-fun |output_gate#173| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#170| state) #b0)) ; \underrun_is_off_EN
(define-fun |output_gate_n underrun_is_off_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#173| state)) #b1))
(declare-fun |output_gate#174| (|output_gate_s|) (_ BitVec 32)) ; \underruns_q
(define-fun |output_gate_n underruns_o| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#174| state))
(define-fun |output_gate_n underruns_q| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#174| state))
(declare-fun |output_gate#175| (|output_gate_s|) (_ BitVec 32)) ; \unfed_q
(define-fun |output_gate_n unfed_q| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#175| state))
(declare-fun |output_gate#176| (|output_gate_s|) (_ BitVec 17)) ; \up_q
(define-fun |output_gate_n up_q| ((state |output_gate_s|)) (_ BitVec 17) (|output_gate#176| state))
(define-fun |output_gate_n wrong| ((state |output_gate_s|)) (_ BitVec 9) (concat (|output_gate#50| state) (concat (ite (|output_gate#49| state) #b1 #b0) (concat (|output_gate#20| state) (ite (|output_gate#47| state) #b1 #b0)))))
(define-fun |output_gate#177| ((state |output_gate_s|)) (_ BitVec 1) (bvnot (ite (|output_gate#56| state) #b1 #b0))) ; $auto$rtlil.cc:3245:Not$1361
(define-fun |output_gate_u 0| ((state |output_gate_s|)) Bool (or (= ((_ extract 0 0) (|output_gate#177| state)) #b1) (not true))) ; $auto$formalff.cc:987:execute$1362
(define-fun |output_gate#178| ((state |output_gate_s|)) Bool (bvule (|output_gate#18| state) #b01111010000100100)) ; $le$output_gate_properties.vh:125$299_Y
(define-fun |output_gate#179| ((state |output_gate_s|)) Bool (bvule (|output_gate#14| state) #b01111010000100100)) ; $le$output_gate_properties.vh:125$300_Y
(define-fun |output_gate#180| ((state |output_gate_s|)) Bool (and (or  (|output_gate#178| state) false) (or  (|output_gate#179| state) false))) ; $logic_and$output_gate_properties.vh:125$301_Y
(define-fun |output_gate#181| ((state |output_gate_s|)) Bool (bvule (|output_gate#15| state) #b01111010000100100)) ; $le$output_gate_properties.vh:125$302_Y
(define-fun |output_gate#182| ((state |output_gate_s|)) Bool (and (or  (|output_gate#180| state) false) (or  (|output_gate#181| state) false))) ; $logic_and$output_gate_properties.vh:125$303_Y
(define-fun |output_gate#183| ((state |output_gate_s|)) Bool (bvule (|output_gate#16| state) #b01111010000100100)) ; $le$output_gate_properties.vh:125$304_Y
(define-fun |output_gate#184| ((state |output_gate_s|)) Bool (and (or  (|output_gate#182| state) false) (or  (|output_gate#183| state) false))) ; $logic_and$output_gate_properties.vh:125$305_Y
(define-fun |output_gate#185| ((state |output_gate_s|)) Bool (bvule (|output_gate#17| state) #b01111010000100100)) ; $le$output_gate_properties.vh:125$306_Y
(define-fun |output_gate#186| ((state |output_gate_s|)) Bool (and (or  (|output_gate#184| state) false) (or  (|output_gate#185| state) false))) ; $logic_and$output_gate_properties.vh:125$307_Y
(define-fun |output_gate_a 0| ((state |output_gate_s|)) Bool (or (|output_gate#186| state) (not (= ((_ extract 0 0) (|output_gate#36| state)) #b1)))) ; _witness_.assert_assert_output_gate_properties_vh_125_298
(define-fun |output_gate#187| ((state |output_gate_s|)) Bool (bvule (|output_gate#176| state) #b01111010000100100)) ; $le$output_gate_properties.vh:126$309_Y
(define-fun |output_gate_a 1| ((state |output_gate_s|)) Bool (or (|output_gate#187| state) (not (= ((_ extract 0 0) (|output_gate#36| state)) #b1)))) ; _witness_.assert_assert_output_gate_properties_vh_126_308
(define-fun |output_gate#188| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#94| state)) #b1) (= ((_ extract 1 1) (|output_gate#94| state)) #b1) (= ((_ extract 2 2) (|output_gate#94| state)) #b1) (= ((_ extract 3 3) (|output_gate#94| state)) #b1) (= ((_ extract 4 4) (|output_gate#94| state)) #b1) (= ((_ extract 5 5) (|output_gate#94| state)) #b1) (= ((_ extract 6 6) (|output_gate#94| state)) #b1) (= ((_ extract 7 7) (|output_gate#94| state)) #b1) (= ((_ extract 8 8) (|output_gate#94| state)) #b1)))) ; $eq$output_gate_properties.vh:130$321_Y
(define-fun |output_gate#189| ((state |output_gate_s|)) Bool (and (or  (|output_gate#188| state) false) (or  (= ((_ extract 0 0) (|output_gate#22| state)) #b1) false))) ; $logic_and$output_gate_properties.vh:130$322_Y
(define-fun |output_gate#190| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#51| state)) #b1) #b1 #b0)) ; $procmux$757_Y
(define-fun |output_gate#191| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#23| state)) #b1) #b0 (|output_gate#190| state))) ; $procmux$759_Y
(define-fun |output_gate#192| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#191| state) #b0)) ; $assert$output_gate_properties.vh:130$320_EN
(define-fun |output_gate_a 2| ((state |output_gate_s|)) Bool (or (|output_gate#189| state) (not (= ((_ extract 0 0) (|output_gate#192| state)) #b1)))) ; _witness_.assert_assert_output_gate_properties_vh_130_320
(define-fun |output_gate#193| ((state |output_gate_s|)) Bool (distinct (|output_gate#175| state) #b00000000000000000000000000000000)) ; $ne$output_gate_properties.vh:132$327_Y
(define-fun |output_gate#194| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 0 0) (|output_gate#98| state)) #b1) false) (or  (|output_gate#193| state) false))) ; $logic_and$output_gate_properties.vh:132$328_Y
(define-fun |output_gate_a 3| ((state |output_gate_s|)) Bool (or (|output_gate#194| state) (not (= ((_ extract 0 0) (|output_gate#158| state)) #b1)))) ; _witness_.assert_assert_output_gate_properties_vh_132_326
(define-fun |output_gate#195| ((state |output_gate_s|)) (_ BitVec 33) (bvadd (concat #b0 (|output_gate#99| state)) #b000000000000000000000000000000001)) ; $add$output_gate_properties.vh:114$267_Y
(define-fun |output_gate#196| ((state |output_gate_s|)) Bool (bvule (concat #b0 (|output_gate#175| state)) (|output_gate#195| state))) ; $le$output_gate_properties.vh:114$268_Y
(define-fun |output_gate#197| ((state |output_gate_s|)) Bool (bvule (|output_gate#175| state) #b00000000000000000000000000000010)) ; $le$output_gate_properties.vh:114$269_Y
(define-fun |output_gate#198| ((state |output_gate_s|)) Bool (or  (|output_gate#196| state) false  (|output_gate#197| state) false)) ; $logic_or$output_gate_properties.vh:114$270_Y
(define-fun |output_gate#199| ((state |output_gate_s|)) Bool (and (or  (|output_gate#194| state) false) (or  (|output_gate#198| state) false))) ; $logic_and$output_gate_properties.vh:135$347_Y
(define-fun |output_gate_a 4| ((state |output_gate_s|)) Bool (or (|output_gate#199| state) (not (= ((_ extract 0 0) (|output_gate#192| state)) #b1)))) ; _witness_.assert_assert_output_gate_properties_vh_135_340
(define-fun |output_gate#200| ((state |output_gate_s|)) Bool (= (|output_gate#14| state) #b01111010000100100)) ; $eq$output_gate_properties.vh:138$355_Y
(define-fun |output_gate#201| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 0 0) (|output_gate#123| state)) #b1) false) (or  (|output_gate#200| state) false))) ; $logic_and$output_gate_properties.vh:138$356_Y
(define-fun |output_gate#202| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#114| state)) #b1) #b1 #b0)) ; $procmux$733_Y
(define-fun |output_gate#203| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#23| state)) #b1) #b0 (|output_gate#202| state))) ; $procmux$735_Y
(define-fun |output_gate#204| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#203| state) #b0)) ; $assert$output_gate_properties.vh:138$354_EN
(define-fun |output_gate_a 5| ((state |output_gate_s|)) Bool (or (|output_gate#201| state) (not (= ((_ extract 0 0) (|output_gate#204| state)) #b1)))) ; _witness_.assert_assert_output_gate_properties_vh_138_354
(define-fun |output_gate#205| ((state |output_gate_s|)) Bool (= (|output_gate#15| state) #b01111010000100100)) ; $eq$output_gate_properties.vh:139$358_Y
(define-fun |output_gate#206| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 1 1) (|output_gate#123| state)) #b1) false) (or  (|output_gate#205| state) false))) ; $logic_and$output_gate_properties.vh:139$359_Y
(define-fun |output_gate#207| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 1 1) (|output_gate#114| state)) #b1) #b1 #b0)) ; $procmux$725_Y
(define-fun |output_gate#208| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#23| state)) #b1) #b0 (|output_gate#207| state))) ; $procmux$727_Y
(define-fun |output_gate#209| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#208| state) #b0)) ; $assert$output_gate_properties.vh:139$357_EN
(define-fun |output_gate_a 6| ((state |output_gate_s|)) Bool (or (|output_gate#206| state) (not (= ((_ extract 0 0) (|output_gate#209| state)) #b1)))) ; _witness_.assert_assert_output_gate_properties_vh_139_357
(define-fun |output_gate#210| ((state |output_gate_s|)) Bool (= (|output_gate#16| state) #b01111010000100100)) ; $eq$output_gate_properties.vh:14$390_Y
(define-fun |output_gate#211| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 2 2) (|output_gate#123| state)) #b1) false) (or  (|output_gate#210| state) false))) ; $logic_and$output_gate_properties.vh:140$362_Y
(define-fun |output_gate#212| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 2 2) (|output_gate#114| state)) #b1) #b1 #b0)) ; $procmux$717_Y
(define-fun |output_gate#213| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#23| state)) #b1) #b0 (|output_gate#212| state))) ; $procmux$719_Y
(define-fun |output_gate#214| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#213| state) #b0)) ; $assert$output_gate_properties.vh:140$360_EN
(define-fun |output_gate_a 7| ((state |output_gate_s|)) Bool (or (|output_gate#211| state) (not (= ((_ extract 0 0) (|output_gate#214| state)) #b1)))) ; _witness_.assert_assert_output_gate_properties_vh_140_360
(define-fun |output_gate#215| ((state |output_gate_s|)) (_ BitVec 17) (bvadd (|output_gate#14| state) #b00000000000000001)) ; $add$output_gate_properties.vh:14$371_Y
(define-fun |output_gate#216| ((state |output_gate_s|)) (_ BitVec 17) (ite (|output_gate#200| state) #b01111010000100100 (|output_gate#215| state))) ; $ternary$output_gate_properties.vh:14$372_Y
(define-fun |output_gate#217| ((state |output_gate_s|)) Bool (= (|output_gate#18| state) (|output_gate#216| state))) ; $eq$output_gate_properties.vh:142$374_Y
(define-fun |output_gate#218| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 0 0) (|output_gate#123| state)) #b1) false) (or  (|output_gate#217| state) false))) ; $logic_and$output_gate_properties.vh:142$375_Y
(define-fun |output_gate#219| ((state |output_gate_s|)) Bool (distinct (|output_gate#18| state) #b00000000000000000)) ; $ne$output_gate_properties.vh:142$366_Y
(define-fun |output_gate#220| ((state |output_gate_s|)) Bool (and (or  (|output_gate#88| state) false) (or  (|output_gate#219| state) false))) ; $logic_and$output_gate_properties.vh:142$367_Y
(define-fun |output_gate#221| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#220| state) #b1 #b0)) ; $procmux$701_Y
(define-fun |output_gate#222| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#23| state)) #b1) #b0 (|output_gate#221| state))) ; $procmux$703_Y
(define-fun |output_gate#223| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#222| state) #b0)) ; $assert$output_gate_properties.vh:142$373_EN
(define-fun |output_gate_a 8| ((state |output_gate_s|)) Bool (or (|output_gate#218| state) (not (= ((_ extract 0 0) (|output_gate#223| state)) #b1)))) ; _witness_.assert_assert_output_gate_properties_vh_142_373
(define-fun |output_gate#224| ((state |output_gate_s|)) (_ BitVec 17) (bvadd (|output_gate#15| state) #b00000000000000001)) ; $add$output_gate_properties.vh:14$381_Y
(define-fun |output_gate#225| ((state |output_gate_s|)) (_ BitVec 17) (ite (|output_gate#205| state) #b01111010000100100 (|output_gate#224| state))) ; $ternary$output_gate_properties.vh:14$382_Y
(define-fun |output_gate#226| ((state |output_gate_s|)) Bool (= (|output_gate#14| state) (|output_gate#225| state))) ; $eq$output_gate_properties.vh:143$384_Y
(define-fun |output_gate#227| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 1 1) (|output_gate#123| state)) #b1) false) (or  (|output_gate#226| state) false))) ; $logic_and$output_gate_properties.vh:143$385_Y
(define-fun |output_gate#228| ((state |output_gate_s|)) Bool (distinct (|output_gate#14| state) #b00000000000000000)) ; $ne$output_gate_properties.vh:143$376_Y
(define-fun |output_gate#229| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 0 0) (|output_gate#123| state)) #b1) false) (or  (|output_gate#228| state) false))) ; $logic_and$output_gate_properties.vh:143$377_Y
(define-fun |output_gate#230| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#229| state) #b1 #b0)) ; $procmux$692_Y
(define-fun |output_gate#231| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#23| state)) #b1) #b0 (|output_gate#230| state))) ; $procmux$694_Y
(define-fun |output_gate#232| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#231| state) #b0)) ; $assert$output_gate_properties.vh:143$383_EN
(define-fun |output_gate_a 9| ((state |output_gate_s|)) Bool (or (|output_gate#227| state) (not (= ((_ extract 0 0) (|output_gate#232| state)) #b1)))) ; _witness_.assert_assert_output_gate_properties_vh_143_383
(define-fun |output_gate#233| ((state |output_gate_s|)) (_ BitVec 17) (bvadd (|output_gate#16| state) #b00000000000000001)) ; $add$output_gate_properties.vh:14$391_Y
(define-fun |output_gate#234| ((state |output_gate_s|)) (_ BitVec 17) (ite (|output_gate#210| state) #b01111010000100100 (|output_gate#233| state))) ; $ternary$output_gate_properties.vh:14$392_Y
(define-fun |output_gate#235| ((state |output_gate_s|)) Bool (= (|output_gate#15| state) (|output_gate#234| state))) ; $eq$output_gate_properties.vh:144$394_Y
(define-fun |output_gate#236| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 2 2) (|output_gate#123| state)) #b1) false) (or  (|output_gate#235| state) false))) ; $logic_and$output_gate_properties.vh:144$395_Y
(define-fun |output_gate#237| ((state |output_gate_s|)) Bool (distinct (|output_gate#15| state) #b00000000000000000)) ; $ne$output_gate_properties.vh:144$386_Y
(define-fun |output_gate#238| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 1 1) (|output_gate#123| state)) #b1) false) (or  (|output_gate#237| state) false))) ; $logic_and$output_gate_properties.vh:144$387_Y
(define-fun |output_gate#239| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#238| state) #b1 #b0)) ; $procmux$683_Y
(define-fun |output_gate#240| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#23| state)) #b1) #b0 (|output_gate#239| state))) ; $procmux$685_Y
(define-fun |output_gate#241| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#240| state) #b0)) ; $assert$output_gate_properties.vh:144$393_EN
(define-fun |output_gate_a 10| ((state |output_gate_s|)) Bool (or (|output_gate#236| state) (not (= ((_ extract 0 0) (|output_gate#241| state)) #b1)))) ; _witness_.assert_assert_output_gate_properties_vh_144_393
(define-fun |output_gate#242| ((state |output_gate_s|)) (_ BitVec 17) (bvadd (|output_gate#17| state) #b00000000000000001)) ; $add$output_gate_properties.vh:14$401_Y
(define-fun |output_gate#243| ((state |output_gate_s|)) Bool (= (|output_gate#17| state) #b01111010000100100)) ; $eq$output_gate_properties.vh:14$400_Y
(define-fun |output_gate#244| ((state |output_gate_s|)) (_ BitVec 17) (ite (|output_gate#243| state) #b01111010000100100 (|output_gate#242| state))) ; $ternary$output_gate_properties.vh:14$402_Y
(define-fun |output_gate#245| ((state |output_gate_s|)) Bool (= (|output_gate#16| state) (|output_gate#244| state))) ; $eq$output_gate_properties.vh:145$404_Y
(define-fun |output_gate#246| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 0 0) (|output_gate#27| state)) #b1) false) (or  (|output_gate#245| state) false))) ; $logic_and$output_gate_properties.vh:145$405_Y
(define-fun |output_gate#247| ((state |output_gate_s|)) Bool (distinct (|output_gate#16| state) #b00000000000000000)) ; $ne$output_gate_properties.vh:145$396_Y
(define-fun |output_gate#248| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 2 2) (|output_gate#123| state)) #b1) false) (or  (|output_gate#247| state) false))) ; $logic_and$output_gate_properties.vh:145$397_Y
(define-fun |output_gate#249| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#248| state) #b1 #b0)) ; $procmux$674_Y
(define-fun |output_gate#250| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#23| state)) #b1) #b0 (|output_gate#249| state))) ; $procmux$676_Y
(define-fun |output_gate#251| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#250| state) #b0)) ; $assert$output_gate_properties.vh:145$403_EN
(define-fun |output_gate_a 11| ((state |output_gate_s|)) Bool (or (|output_gate#246| state) (not (= ((_ extract 0 0) (|output_gate#251| state)) #b1)))) ; _witness_.assert_assert_output_gate_properties_vh_145_403
(define-fun |output_gate#252| ((state |output_gate_s|)) Bool (bvuge (|output_gate#176| state) (|output_gate#17| state))) ; $ge$output_gate_properties.vh:146$407_Y
(define-fun |output_gate#253| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#27| state)) #b1) #b1 #b0)) ; $procmux$665_Y
(define-fun |output_gate#254| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#23| state)) #b1) #b0 (|output_gate#253| state))) ; $procmux$667_Y
(define-fun |output_gate#255| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (|output_gate#254| state) #b0)) ; $assert$output_gate_properties.vh:146$406_EN
(define-fun |output_gate_a 12| ((state |output_gate_s|)) Bool (or (|output_gate#252| state) (not (= ((_ extract 0 0) (|output_gate#255| state)) #b1)))) ; _witness_.assert_assert_output_gate_properties_vh_146_406
(define-fun |output_gate#256| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#94| state)) #b1) (= ((_ extract 1 1) (|output_gate#94| state)) #b1) (= ((_ extract 2 2) (|output_gate#94| state)) #b1) (= ((_ extract 3 3) (|output_gate#94| state)) #b1) (= ((_ extract 4 4) (|output_gate#94| state)) #b1) (= ((_ extract 5 5) (|output_gate#94| state)) #b1) (= ((_ extract 6 6) (|output_gate#94| state)) #b1) (= ((_ extract 7 7) (|output_gate#94| state)) #b1) (= ((_ extract 8 8) (|output_gate#94| state)) #b1) false false false false false false false))) ; $eq$output_gate_properties.vh:112$261_Y
(define-fun |output_gate#257| ((state |output_gate_s|)) Bool (and (or  (|output_gate#89| state) false) (or  (|output_gate#256| state) false))) ; $logic_and$output_gate_properties.vh:32$93_Y
(define-fun |output_gate#258| ((state |output_gate_s|)) Bool (and (or  (|output_gate#257| state) false) (or  (|output_gate#46| state) false))) ; $logic_and$output_gate_properties.vh:32$94_Y
(define-fun |output_gate#259| ((state |output_gate_s|)) Bool (and (or  (|output_gate#258| state) false) (or  (|output_gate#48| state) false))) ; $logic_and$output_gate_properties.vh:32$95_Y
(define-fun |output_gate#260| ((state |output_gate_s|)) Bool (and (or  (|output_gate#259| state) false) (or  (|output_gate#101| state) false))) ; $logic_and$output_gate_properties.vh:32$96_Y
(define-fun |output_gate#261| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#38| state) #b1 #b0)) ; $assume$output_gate_properties.vh:32$91_EN
(define-fun |output_gate_u 1| ((state |output_gate_s|)) Bool (or (|output_gate#260| state) (not (= ((_ extract 0 0) (|output_gate#261| state)) #b1)))) ; _witness_.assume_assume_output_gate_properties_vh_32_91
(define-fun |output_gate#262| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#23| state)) #b1) false))) ; $logic_not$output_gate_properties.vh:33$98_Y
(define-fun |output_gate#263| ((state |output_gate_s|)) Bool (or  (|output_gate#262| state) false  (|output_gate#149| state) false)) ; $logic_or$output_gate_properties.vh:33$99_Y
(define-fun |output_gate_u 2| ((state |output_gate_s|)) Bool (or (|output_gate#263| state) (not true))) ; _witness_.assume_assume_output_gate_properties_vh_33_97
(define-fun |output_gate#264| ((state |output_gate_s|)) Bool (|output_gate_is| state)) ; $auto$rtlil.cc:3293:And$1058
(define-fun |output_gate_u 3| ((state |output_gate_s|)) Bool (or (|output_gate#149| state) (not (|output_gate#264| state)))) ; _witness_.assume_assume_output_gate_properties_vh_36_410
(define-fun |output_gate#265| ((state |output_gate_s|)) (_ BitVec 32) (bvadd (|output_gate#92| state) #b00000000000000000000000000000001)) ; $add$output_gate_properties.vh:105$244_Y
(define-fun |output_gate#266| ((state |output_gate_s|)) Bool (= (|output_gate#93| state) (|output_gate#265| state))) ; $eq$output_gate_properties.vh:105$245_Y
(define-fun |output_gate#267| ((state |output_gate_s|)) Bool (= (|output_gate#95| state) (|output_gate#121| state))) ; $eq$output_gate_properties.vh:105$246_Y
(define-fun |output_gate#268| ((state |output_gate_s|)) Bool (and (or  (|output_gate#266| state) false) (or  (|output_gate#267| state) false))) ; $logic_and$output_gate_properties.vh:105$247_Y
(define-fun |output_gate_a 13| ((state |output_gate_s|)) Bool (or (|output_gate#268| state) (not (= ((_ extract 0 0) (|output_gate#9| state)) #b1)))) ; a_fault_is_counted
(define-fun |output_gate#269| ((state |output_gate_s|)) Bool (distinct ((_ extract 8 4) (|output_gate#94| state)) #b00000)) ; $ne$output_gate_properties.vh:116$273_Y
(define-fun |output_gate_a 14| ((state |output_gate_s|)) Bool (or (|output_gate#269| state) (not (= ((_ extract 0 0) (|output_gate#13| state)) #b1)))) ; a_limit_rests
(define-fun |output_gate#270| ((state |output_gate_s|)) Bool (distinct (concat #b0000000 (|output_gate#94| state)) #b0000000000000000)) ; $ne$output_gate_properties.vh:131$323_Y
(define-fun |output_gate#271| ((state |output_gate_s|)) Bool (= (|output_gate#96| state) (ite (|output_gate#270| state) #b1 #b0))) ; $eq$output_gate_properties.vh:131$324_Y
(define-fun |output_gate_a 15| ((state |output_gate_s|)) Bool (or (|output_gate#271| state) (not (= ((_ extract 0 0) (|output_gate#36| state)) #b1)))) ; any_is_known
(define-fun |output_gate#272| ((state |output_gate_s|)) Bool (not (or  (|output_gate#34| state) false))) ; $logic_not$output_gate_properties.vh:82$201_Y
(define-fun |output_gate_a 16| ((state |output_gate_s|)) Bool (or (|output_gate#272| state) (not (= ((_ extract 0 0) (|output_gate#44| state)) #b1)))) ; beyond_is_off
(define-fun |output_gate#273| ((state |output_gate_s|)) Bool (= (|output_gate#93| state) (|output_gate#92| state))) ; $eq$output_gate_properties.vh:106$248_Y
(define-fun |output_gate_a 17| ((state |output_gate_s|)) Bool (or (|output_gate#273| state) (not (= ((_ extract 0 0) (|output_gate#60| state)) #b1)))) ; counted_once
(define-fun |output_gate#274| ((state |output_gate_s|)) Bool (or  (|output_gate#89| state) false  (|output_gate#84| state) false)) ; $logic_or$output_gate_properties.vh:108$258_Y
(define-fun |output_gate#275| ((state |output_gate_s|)) Bool (or  (|output_gate#274| state) false  (|output_gate#86| state) false)) ; $logic_or$output_gate_properties.vh:108$260_Y
(define-fun |output_gate_a 18| ((state |output_gate_s|)) Bool (or (|output_gate#275| state) (not (= ((_ extract 0 0) (|output_gate#67| state)) #b1)))) ; disarm_is_obeyed
(define-fun |output_gate_a 19| ((state |output_gate_s|)) Bool (or (|output_gate#275| state) (not (= ((_ extract 0 0) (|output_gate#70| state)) #b1)))) ; disarmed_for_good
(define-fun |output_gate#276| ((state |output_gate_s|)) (_ BitVec 32) (bvnot (concat #b000000000000000000000000000 ((_ extract 8 4) (|output_gate#94| state))))) ; $not$output_gate_properties.vh:104$239_Y
(define-fun |output_gate#277| ((state |output_gate_s|)) (_ BitVec 32) (bvand (concat #b000000000000000000000000000 (|output_gate#73| state)) (|output_gate#276| state))) ; $and$output_gate_properties.vh:104$240_Y
(define-fun |output_gate#278| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#277| state)) #b1) (= ((_ extract 1 1) (|output_gate#277| state)) #b1) (= ((_ extract 2 2) (|output_gate#277| state)) #b1) (= ((_ extract 3 3) (|output_gate#277| state)) #b1) (= ((_ extract 4 4) (|output_gate#277| state)) #b1) (= ((_ extract 5 5) (|output_gate#277| state)) #b1) (= ((_ extract 6 6) (|output_gate#277| state)) #b1) (= ((_ extract 7 7) (|output_gate#277| state)) #b1) (= ((_ extract 8 8) (|output_gate#277| state)) #b1) (= ((_ extract 9 9) (|output_gate#277| state)) #b1) (= ((_ extract 10 10) (|output_gate#277| state)) #b1) (= ((_ extract 11 11) (|output_gate#277| state)) #b1) (= ((_ extract 12 12) (|output_gate#277| state)) #b1) (= ((_ extract 13 13) (|output_gate#277| state)) #b1) (= ((_ extract 14 14) (|output_gate#277| state)) #b1) (= ((_ extract 15 15) (|output_gate#277| state)) #b1) (= ((_ extract 16 16) (|output_gate#277| state)) #b1) (= ((_ extract 17 17) (|output_gate#277| state)) #b1) (= ((_ extract 18 18) (|output_gate#277| state)) #b1) (= ((_ extract 19 19) (|output_gate#277| state)) #b1) (= ((_ extract 20 20) (|output_gate#277| state)) #b1) (= ((_ extract 21 21) (|output_gate#277| state)) #b1) (= ((_ extract 22 22) (|output_gate#277| state)) #b1) (= ((_ extract 23 23) (|output_gate#277| state)) #b1) (= ((_ extract 24 24) (|output_gate#277| state)) #b1) (= ((_ extract 25 25) (|output_gate#277| state)) #b1) (= ((_ extract 26 26) (|output_gate#277| state)) #b1) (= ((_ extract 27 27) (|output_gate#277| state)) #b1) (= ((_ extract 28 28) (|output_gate#277| state)) #b1) (= ((_ extract 29 29) (|output_gate#277| state)) #b1) (= ((_ extract 30 30) (|output_gate#277| state)) #b1) (= ((_ extract 31 31) (|output_gate#277| state)) #b1)))) ; $eq$output_gate_properties.vh:104$241_Y
(define-fun |output_gate_a 20| ((state |output_gate_s|)) Bool (or (|output_gate#278| state) (not (= ((_ extract 0 0) (|output_gate#75| state)) #b1)))) ; edges_are_kept
(define-fun |output_gate#279| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 0 0) (|output_gate#27| state)) #b1) false) (or  (|output_gate#243| state) false))) ; $logic_and$output_gate_properties.vh:141$365_Y
(define-fun |output_gate_a 21| ((state |output_gate_s|)) Bool (or (|output_gate#279| state) (not (= ((_ extract 0 0) (|output_gate#78| state)) #b1)))) ; edges_once_settled
(define-fun |output_gate_a 22| ((state |output_gate_s|)) Bool (or (= ((_ extract 2 2) (|output_gate#94| state)) #b1) (not (= ((_ extract 0 0) (|output_gate#108| state)) #b1)))) ; heat_is_kept
(define-fun |output_gate_a 23| ((state |output_gate_s|)) Bool (or (|output_gate#272| state) (not (= ((_ extract 0 0) (|output_gate#109| state)) #b1)))) ; hot_is_off
(define-fun |output_gate#280| ((state |output_gate_s|)) (_ BitVec 32) (bvand (concat #b000000000000000000000000000 (|output_gate#41| state)) (|output_gate#276| state))) ; $and$output_gate_properties.vh:98$230_Y
(define-fun |output_gate#281| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#280| state)) #b1) (= ((_ extract 1 1) (|output_gate#280| state)) #b1) (= ((_ extract 2 2) (|output_gate#280| state)) #b1) (= ((_ extract 3 3) (|output_gate#280| state)) #b1) (= ((_ extract 4 4) (|output_gate#280| state)) #b1) (= ((_ extract 5 5) (|output_gate#280| state)) #b1) (= ((_ extract 6 6) (|output_gate#280| state)) #b1) (= ((_ extract 7 7) (|output_gate#280| state)) #b1) (= ((_ extract 8 8) (|output_gate#280| state)) #b1) (= ((_ extract 9 9) (|output_gate#280| state)) #b1) (= ((_ extract 10 10) (|output_gate#280| state)) #b1) (= ((_ extract 11 11) (|output_gate#280| state)) #b1) (= ((_ extract 12 12) (|output_gate#280| state)) #b1) (= ((_ extract 13 13) (|output_gate#280| state)) #b1) (= ((_ extract 14 14) (|output_gate#280| state)) #b1) (= ((_ extract 15 15) (|output_gate#280| state)) #b1) (= ((_ extract 16 16) (|output_gate#280| state)) #b1) (= ((_ extract 17 17) (|output_gate#280| state)) #b1) (= ((_ extract 18 18) (|output_gate#280| state)) #b1) (= ((_ extract 19 19) (|output_gate#280| state)) #b1) (= ((_ extract 20 20) (|output_gate#280| state)) #b1) (= ((_ extract 21 21) (|output_gate#280| state)) #b1) (= ((_ extract 22 22) (|output_gate#280| state)) #b1) (= ((_ extract 23 23) (|output_gate#280| state)) #b1) (= ((_ extract 24 24) (|output_gate#280| state)) #b1) (= ((_ extract 25 25) (|output_gate#280| state)) #b1) (= ((_ extract 26 26) (|output_gate#280| state)) #b1) (= ((_ extract 27 27) (|output_gate#280| state)) #b1) (= ((_ extract 28 28) (|output_gate#280| state)) #b1) (= ((_ extract 29 29) (|output_gate#280| state)) #b1) (= ((_ extract 30 30) (|output_gate#280| state)) #b1) (= ((_ extract 31 31) (|output_gate#280| state)) #b1)))) ; $eq$output_gate_properties.vh:98$231_Y
(define-fun |output_gate_a 24| ((state |output_gate_s|)) Bool (or (|output_gate#281| state) (not (= ((_ extract 0 0) (|output_gate#111| state)) #b1)))) ; limits_are_kept
(define-fun |output_gate#282| ((state |output_gate_s|)) Bool (distinct (|output_gate#123| state) #b000)) ; $ne$output_gate.v:138$52_Y
(define-fun |output_gate#283| ((state |output_gate_s|)) Bool (or  (|output_gate#88| state) false  (|output_gate#282| state) false)) ; $logic_or$output_gate.v:138$53_Y
(define-fun |output_gate#284| ((state |output_gate_s|)) Bool (or  (|output_gate#283| state) false  (= ((_ extract 0 0) (|output_gate#27| state)) #b1) false)) ; $logic_or$output_gate_properties.vh:129$318_Y
(define-fun |output_gate#285| ((state |output_gate_s|)) Bool (= (|output_gate#51| state) (ite (|output_gate#284| state) #b1 #b0))) ; $eq$output_gate_properties.vh:129$319_Y
(define-fun |output_gate_a 25| ((state |output_gate_s|)) Bool (or (|output_gate#285| state) (not (= ((_ extract 0 0) (|output_gate#36| state)) #b1)))) ; live_is_anything_on
(define-fun |output_gate#286| ((state |output_gate_s|)) (_ BitVec 32) (bvnot (|output_gate#112| state))) ; $not$output_gate_properties.vh:90$218_Y
(define-fun |output_gate#287| ((state |output_gate_s|)) (_ BitVec 32) (bvand (|output_gate#24| state) (|output_gate#286| state))) ; $and$output_gate_properties.vh:90$219_Y
(define-fun |output_gate#288| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#287| state)) #b1) (= ((_ extract 1 1) (|output_gate#287| state)) #b1) (= ((_ extract 2 2) (|output_gate#287| state)) #b1) (= ((_ extract 3 3) (|output_gate#287| state)) #b1) (= ((_ extract 4 4) (|output_gate#287| state)) #b1) (= ((_ extract 5 5) (|output_gate#287| state)) #b1) (= ((_ extract 6 6) (|output_gate#287| state)) #b1) (= ((_ extract 7 7) (|output_gate#287| state)) #b1) (= ((_ extract 8 8) (|output_gate#287| state)) #b1) (= ((_ extract 9 9) (|output_gate#287| state)) #b1) (= ((_ extract 10 10) (|output_gate#287| state)) #b1) (= ((_ extract 11 11) (|output_gate#287| state)) #b1) (= ((_ extract 12 12) (|output_gate#287| state)) #b1) (= ((_ extract 13 13) (|output_gate#287| state)) #b1) (= ((_ extract 14 14) (|output_gate#287| state)) #b1) (= ((_ extract 15 15) (|output_gate#287| state)) #b1) (= ((_ extract 16 16) (|output_gate#287| state)) #b1) (= ((_ extract 17 17) (|output_gate#287| state)) #b1) (= ((_ extract 18 18) (|output_gate#287| state)) #b1) (= ((_ extract 19 19) (|output_gate#287| state)) #b1) (= ((_ extract 20 20) (|output_gate#287| state)) #b1) (= ((_ extract 21 21) (|output_gate#287| state)) #b1) (= ((_ extract 22 22) (|output_gate#287| state)) #b1) (= ((_ extract 23 23) (|output_gate#287| state)) #b1) (= ((_ extract 24 24) (|output_gate#287| state)) #b1) (= ((_ extract 25 25) (|output_gate#287| state)) #b1) (= ((_ extract 26 26) (|output_gate#287| state)) #b1) (= ((_ extract 27 27) (|output_gate#287| state)) #b1) (= ((_ extract 28 28) (|output_gate#287| state)) #b1) (= ((_ extract 29 29) (|output_gate#287| state)) #b1) (= ((_ extract 30 30) (|output_gate#287| state)) #b1) (= ((_ extract 31 31) (|output_gate#287| state)) #b1)))) ; $eq$output_gate_properties.vh:90$220_Y
(define-fun |output_gate_a 26| ((state |output_gate_s|)) Bool (or (|output_gate#288| state) (not (= ((_ extract 0 0) (|output_gate#113| state)) #b1)))) ; mask_is_kept
(define-fun |output_gate#289| ((state |output_gate_s|)) Bool (= (|output_gate#18| state) #b01111010000100100)) ; $eq$output_gate_properties.vh:137$353_Y
(define-fun |output_gate_a 27| ((state |output_gate_s|)) Bool (or (|output_gate#289| state) (not (= ((_ extract 0 0) (|output_gate#117| state)) #b1)))) ; moves_once_settled
(define-fun |output_gate#290| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#24| state)) #b1) (= ((_ extract 1 1) (|output_gate#24| state)) #b1) (= ((_ extract 2 2) (|output_gate#24| state)) #b1) (= ((_ extract 3 3) (|output_gate#24| state)) #b1) (= ((_ extract 4 4) (|output_gate#24| state)) #b1) (= ((_ extract 5 5) (|output_gate#24| state)) #b1) (= ((_ extract 6 6) (|output_gate#24| state)) #b1) (= ((_ extract 7 7) (|output_gate#24| state)) #b1) (= ((_ extract 8 8) (|output_gate#24| state)) #b1) (= ((_ extract 9 9) (|output_gate#24| state)) #b1) (= ((_ extract 10 10) (|output_gate#24| state)) #b1) (= ((_ extract 11 11) (|output_gate#24| state)) #b1) (= ((_ extract 12 12) (|output_gate#24| state)) #b1) (= ((_ extract 13 13) (|output_gate#24| state)) #b1) (= ((_ extract 14 14) (|output_gate#24| state)) #b1) (= ((_ extract 15 15) (|output_gate#24| state)) #b1) (= ((_ extract 16 16) (|output_gate#24| state)) #b1) (= ((_ extract 17 17) (|output_gate#24| state)) #b1) (= ((_ extract 18 18) (|output_gate#24| state)) #b1) (= ((_ extract 19 19) (|output_gate#24| state)) #b1) (= ((_ extract 20 20) (|output_gate#24| state)) #b1) (= ((_ extract 21 21) (|output_gate#24| state)) #b1) (= ((_ extract 22 22) (|output_gate#24| state)) #b1) (= ((_ extract 23 23) (|output_gate#24| state)) #b1) (= ((_ extract 24 24) (|output_gate#24| state)) #b1) (= ((_ extract 25 25) (|output_gate#24| state)) #b1) (= ((_ extract 26 26) (|output_gate#24| state)) #b1) (= ((_ extract 27 27) (|output_gate#24| state)) #b1) (= ((_ extract 28 28) (|output_gate#24| state)) #b1) (= ((_ extract 29 29) (|output_gate#24| state)) #b1) (= ((_ extract 30 30) (|output_gate#24| state)) #b1) (= ((_ extract 31 31) (|output_gate#24| state)) #b1)))) ; $eq$output_gate_properties.vh:119$280_Y
(define-fun |output_gate#291| ((state |output_gate_s|)) Bool (or  (|output_gate#290| state) false  (= ((_ extract 0 0) (|output_gate#27| state)) #b1) false)) ; $logic_or$output_gate_properties.vh:119$281_Y
(define-fun |output_gate_a 28| ((state |output_gate_s|)) Bool (or (|output_gate#291| state) (not (= ((_ extract 0 0) (|output_gate#113| state)) #b1)))) ; no_channel_alone
(define-fun |output_gate#292| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#27| state)) #b1) false))) ; $logic_not$output_gate_properties.vh:40$102_Y
(define-fun |output_gate#293| ((state |output_gate_s|)) Bool (and (or  (|output_gate#290| state) false) (or  (|output_gate#292| state) false))) ; $logic_and$output_gate_properties.vh:40$103_Y
(define-fun |output_gate#294| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#30| state)) #b1) false))) ; $logic_not$output_gate_properties.vh:120$282_Y
(define-fun |output_gate#295| ((state |output_gate_s|)) Bool (and (or  (|output_gate#293| state) false) (or  (|output_gate#294| state) false))) ; $logic_and$output_gate_properties.vh:40$105_Y
(define-fun |output_gate#296| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#33| state)) #b1) false))) ; $logic_not$output_gate_properties.vh:120$283_Y
(define-fun |output_gate#297| ((state |output_gate_s|)) Bool (and (or  (|output_gate#295| state) false) (or  (|output_gate#296| state) false))) ; $logic_and$output_gate_properties.vh:40$107_Y
(define-fun |output_gate_a 29| ((state |output_gate_s|)) Bool (or (|output_gate#297| state) (not (= ((_ extract 0 0) (|output_gate#118| state)) #b1)))) ; no_clock_is_off
(define-fun |output_gate#298| ((state |output_gate_s|)) Bool (and (or  (|output_gate#294| state) false) (or  (|output_gate#296| state) false))) ; $logic_and$output_gate_properties.vh:120$284_Y
(define-fun |output_gate#299| ((state |output_gate_s|)) Bool (or  (= ((_ extract 0 0) (|output_gate#27| state)) #b1) false  (|output_gate#298| state) false)) ; $logic_or$output_gate_properties.vh:120$285_Y
(define-fun |output_gate_a 30| ((state |output_gate_s|)) Bool (or (|output_gate#299| state) (not (= ((_ extract 0 0) (|output_gate#113| state)) #b1)))) ; no_sign_of_life_alone
(define-fun |output_gate_a 31| ((state |output_gate_s|)) Bool (or (|output_gate#272| state) (not (= ((_ extract 0 0) (|output_gate#120| state)) #b1)))) ; nonsense_is_off
(define-fun |output_gate_a 32| ((state |output_gate_s|)) Bool (or (= ((_ extract 0 0) (|output_gate#22| state)) #b1) (not (= ((_ extract 0 0) (|output_gate#125| state)) #b1)))) ; on_once_armed
(define-fun |output_gate#300| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 0 0) (|output_gate#98| state)) #b1) false) (or  (|output_gate#198| state) false))) ; $logic_and$output_gate_properties.vh:114$271_Y
(define-fun |output_gate_a 33| ((state |output_gate_s|)) Bool (or (|output_gate#300| state) (not (= ((_ extract 0 0) (|output_gate#125| state)) #b1)))) ; on_while_fed
(define-fun |output_gate_a 34| ((state |output_gate_s|)) Bool (or (|output_gate#256| state) (not (= ((_ extract 0 0) (|output_gate#125| state)) #b1)))) ; on_without_fault
(define-fun |output_gate#301| ((state |output_gate_s|)) (_ BitVec 32) (bvnot (concat #b0000000000000000 (|output_gate#2| state)))) ; $not$output_gate_properties.vh:107$251_Y
(define-fun |output_gate#302| ((state |output_gate_s|)) (_ BitVec 32) (bvand (concat #b00000000000000000000000 (|output_gate#94| state)) (|output_gate#301| state))) ; $and$output_gate_properties.vh:107$252_Y
(define-fun |output_gate#303| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#302| state)) #b1) (= ((_ extract 1 1) (|output_gate#302| state)) #b1) (= ((_ extract 2 2) (|output_gate#302| state)) #b1) (= ((_ extract 3 3) (|output_gate#302| state)) #b1) (= ((_ extract 4 4) (|output_gate#302| state)) #b1) (= ((_ extract 5 5) (|output_gate#302| state)) #b1) (= ((_ extract 6 6) (|output_gate#302| state)) #b1) (= ((_ extract 7 7) (|output_gate#302| state)) #b1) (= ((_ extract 8 8) (|output_gate#302| state)) #b1) (= ((_ extract 9 9) (|output_gate#302| state)) #b1) (= ((_ extract 10 10) (|output_gate#302| state)) #b1) (= ((_ extract 11 11) (|output_gate#302| state)) #b1) (= ((_ extract 12 12) (|output_gate#302| state)) #b1) (= ((_ extract 13 13) (|output_gate#302| state)) #b1) (= ((_ extract 14 14) (|output_gate#302| state)) #b1) (= ((_ extract 15 15) (|output_gate#302| state)) #b1) (= ((_ extract 16 16) (|output_gate#302| state)) #b1) (= ((_ extract 17 17) (|output_gate#302| state)) #b1) (= ((_ extract 18 18) (|output_gate#302| state)) #b1) (= ((_ extract 19 19) (|output_gate#302| state)) #b1) (= ((_ extract 20 20) (|output_gate#302| state)) #b1) (= ((_ extract 21 21) (|output_gate#302| state)) #b1) (= ((_ extract 22 22) (|output_gate#302| state)) #b1) (= ((_ extract 23 23) (|output_gate#302| state)) #b1) (= ((_ extract 24 24) (|output_gate#302| state)) #b1) (= ((_ extract 25 25) (|output_gate#302| state)) #b1) (= ((_ extract 26 26) (|output_gate#302| state)) #b1) (= ((_ extract 27 27) (|output_gate#302| state)) #b1) (= ((_ extract 28 28) (|output_gate#302| state)) #b1) (= ((_ extract 29 29) (|output_gate#302| state)) #b1) (= ((_ extract 30 30) (|output_gate#302| state)) #b1) (= ((_ extract 31 31) (|output_gate#302| state)) #b1)))) ; $eq$output_gate_properties.vh:107$253_Y
(define-fun |output_gate_a 35| ((state |output_gate_s|)) Bool (or (|output_gate#303| state) (not (= ((_ extract 0 0) (|output_gate#128| state)) #b1)))) ; only_a_cause_is_kept
(define-fun |output_gate#304| ((state |output_gate_s|)) (_ BitVec 32) (bvnot (concat #b00000000000000000000000 (|output_gate#94| state)))) ; $not$output_gate_properties.vh:102$235_Y
(define-fun |output_gate#305| ((state |output_gate_s|)) (_ BitVec 32) (bvand (concat #b0000000000000000 (|output_gate#2| state)) (|output_gate#304| state))) ; $and$output_gate_properties.vh:102$236_Y
(define-fun |output_gate#306| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#305| state)) #b1) (= ((_ extract 1 1) (|output_gate#305| state)) #b1) (= ((_ extract 2 2) (|output_gate#305| state)) #b1) (= ((_ extract 3 3) (|output_gate#305| state)) #b1) (= ((_ extract 4 4) (|output_gate#305| state)) #b1) (= ((_ extract 5 5) (|output_gate#305| state)) #b1) (= ((_ extract 6 6) (|output_gate#305| state)) #b1) (= ((_ extract 7 7) (|output_gate#305| state)) #b1) (= ((_ extract 8 8) (|output_gate#305| state)) #b1) (= ((_ extract 9 9) (|output_gate#305| state)) #b1) (= ((_ extract 10 10) (|output_gate#305| state)) #b1) (= ((_ extract 11 11) (|output_gate#305| state)) #b1) (= ((_ extract 12 12) (|output_gate#305| state)) #b1) (= ((_ extract 13 13) (|output_gate#305| state)) #b1) (= ((_ extract 14 14) (|output_gate#305| state)) #b1) (= ((_ extract 15 15) (|output_gate#305| state)) #b1) (= ((_ extract 16 16) (|output_gate#305| state)) #b1) (= ((_ extract 17 17) (|output_gate#305| state)) #b1) (= ((_ extract 18 18) (|output_gate#305| state)) #b1) (= ((_ extract 19 19) (|output_gate#305| state)) #b1) (= ((_ extract 20 20) (|output_gate#305| state)) #b1) (= ((_ extract 21 21) (|output_gate#305| state)) #b1) (= ((_ extract 22 22) (|output_gate#305| state)) #b1) (= ((_ extract 23 23) (|output_gate#305| state)) #b1) (= ((_ extract 24 24) (|output_gate#305| state)) #b1) (= ((_ extract 25 25) (|output_gate#305| state)) #b1) (= ((_ extract 26 26) (|output_gate#305| state)) #b1) (= ((_ extract 27 27) (|output_gate#305| state)) #b1) (= ((_ extract 28 28) (|output_gate#305| state)) #b1) (= ((_ extract 29 29) (|output_gate#305| state)) #b1) (= ((_ extract 30 30) (|output_gate#305| state)) #b1) (= ((_ extract 31 31) (|output_gate#305| state)) #b1)))) ; $eq$output_gate_properties.vh:102$237_Y
(define-fun |output_gate_a 36| ((state |output_gate_s|)) Bool (or (|output_gate#306| state) (not (= ((_ extract 0 0) (|output_gate#131| state)) #b1)))) ; only_a_command_clears
(define-fun |output_gate#307| ((state |output_gate_s|)) (_ BitVec 32) (bvnot (|output_gate#71| state))) ; $not$output_gate_properties.vh:91$221_Y
(define-fun |output_gate#308| ((state |output_gate_s|)) (_ BitVec 32) (bvand (|output_gate#24| state) (|output_gate#307| state))) ; $and$output_gate_properties.vh:91$222_Y
(define-fun |output_gate#309| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#308| state)) #b1) (= ((_ extract 1 1) (|output_gate#308| state)) #b1) (= ((_ extract 2 2) (|output_gate#308| state)) #b1) (= ((_ extract 3 3) (|output_gate#308| state)) #b1) (= ((_ extract 4 4) (|output_gate#308| state)) #b1) (= ((_ extract 5 5) (|output_gate#308| state)) #b1) (= ((_ extract 6 6) (|output_gate#308| state)) #b1) (= ((_ extract 7 7) (|output_gate#308| state)) #b1) (= ((_ extract 8 8) (|output_gate#308| state)) #b1) (= ((_ extract 9 9) (|output_gate#308| state)) #b1) (= ((_ extract 10 10) (|output_gate#308| state)) #b1) (= ((_ extract 11 11) (|output_gate#308| state)) #b1) (= ((_ extract 12 12) (|output_gate#308| state)) #b1) (= ((_ extract 13 13) (|output_gate#308| state)) #b1) (= ((_ extract 14 14) (|output_gate#308| state)) #b1) (= ((_ extract 15 15) (|output_gate#308| state)) #b1) (= ((_ extract 16 16) (|output_gate#308| state)) #b1) (= ((_ extract 17 17) (|output_gate#308| state)) #b1) (= ((_ extract 18 18) (|output_gate#308| state)) #b1) (= ((_ extract 19 19) (|output_gate#308| state)) #b1) (= ((_ extract 20 20) (|output_gate#308| state)) #b1) (= ((_ extract 21 21) (|output_gate#308| state)) #b1) (= ((_ extract 22 22) (|output_gate#308| state)) #b1) (= ((_ extract 23 23) (|output_gate#308| state)) #b1) (= ((_ extract 24 24) (|output_gate#308| state)) #b1) (= ((_ extract 25 25) (|output_gate#308| state)) #b1) (= ((_ extract 26 26) (|output_gate#308| state)) #b1) (= ((_ extract 27 27) (|output_gate#308| state)) #b1) (= ((_ extract 28 28) (|output_gate#308| state)) #b1) (= ((_ extract 29 29) (|output_gate#308| state)) #b1) (= ((_ extract 30 30) (|output_gate#308| state)) #b1) (= ((_ extract 31 31) (|output_gate#308| state)) #b1)))) ; $eq$output_gate_properties.vh:91$223_Y
(define-fun |output_gate_a 37| ((state |output_gate_s|)) Bool (or (|output_gate#309| state) (not (= ((_ extract 0 0) (|output_gate#113| state)) #b1)))) ; only_what_is_played
(define-fun |output_gate#310| ((state |output_gate_s|)) Bool (and (or  (|output_gate#272| state) false) (or  (|output_gate#89| state) false))) ; $logic_and$output_gate_properties.vh:82$203_Y
(define-fun |output_gate#311| ((state |output_gate_s|)) Bool (and (or  (|output_gate#310| state) false) (or  (|output_gate#256| state) false))) ; $logic_and$output_gate_properties.vh:82$205_Y
(define-fun |output_gate#312| ((state |output_gate_s|)) Bool (and (or  (|output_gate#311| state) false) (or  (= ((_ extract 0 0) (|output_gate#20| state)) #b1) false))) ; $logic_and$output_gate_properties.vh:82$207_Y
(define-fun |output_gate_a 38| ((state |output_gate_s|)) Bool (or (|output_gate#312| state) (not (= ((_ extract 0 0) (|output_gate#138| state)) #b1)))) ; reset_is_off
(define-fun |output_gate#313| ((state |output_gate_s|)) Bool (= (|output_gate#139| state) (ite (|output_gate#11| state) #b1 #b0))) ; $eq$output_gate_properties.vh:127$311_Y
(define-fun |output_gate#314| ((state |output_gate_s|)) Bool (bvule (|output_gate#10| state) #b00000000111011100110101100101000)) ; $le$output_gate_properties.vh:127$312_Y
(define-fun |output_gate#315| ((state |output_gate_s|)) Bool (and (or  (|output_gate#313| state) false) (or  (|output_gate#314| state) false))) ; $logic_and$output_gate_properties.vh:127$313_Y
(define-fun |output_gate_a 39| ((state |output_gate_s|)) Bool (or (|output_gate#315| state) (not (= ((_ extract 0 0) (|output_gate#36| state)) #b1)))) ; rest_has_its_time
(define-fun |output_gate#316| ((state |output_gate_s|)) (_ BitVec 32) (bvsub #b00000000111011100110101100101000 (|output_gate#10| state))) ; $sub$output_gate_properties.vh:128$314_Y
(define-fun |output_gate#317| ((state |output_gate_s|)) Bool (= (|output_gate#147| state) (|output_gate#316| state))) ; $eq$output_gate_properties.vh:128$315_Y
(define-fun |output_gate_a 40| ((state |output_gate_s|)) Bool (or (|output_gate#317| state) (not (= ((_ extract 0 0) (|output_gate#142| state)) #b1)))) ; rest_is_counted
(define-fun |output_gate#318| ((state |output_gate_s|)) (_ BitVec 32) (bvand (concat #b000000000000000000000000000 (|output_gate#97| state)) (|output_gate#276| state))) ; $and$output_gate_properties.vh:117$278_Y
(define-fun |output_gate#319| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#318| state)) #b1) (= ((_ extract 1 1) (|output_gate#318| state)) #b1) (= ((_ extract 2 2) (|output_gate#318| state)) #b1) (= ((_ extract 3 3) (|output_gate#318| state)) #b1) (= ((_ extract 4 4) (|output_gate#318| state)) #b1) (= ((_ extract 5 5) (|output_gate#318| state)) #b1) (= ((_ extract 6 6) (|output_gate#318| state)) #b1) (= ((_ extract 7 7) (|output_gate#318| state)) #b1) (= ((_ extract 8 8) (|output_gate#318| state)) #b1) (= ((_ extract 9 9) (|output_gate#318| state)) #b1) (= ((_ extract 10 10) (|output_gate#318| state)) #b1) (= ((_ extract 11 11) (|output_gate#318| state)) #b1) (= ((_ extract 12 12) (|output_gate#318| state)) #b1) (= ((_ extract 13 13) (|output_gate#318| state)) #b1) (= ((_ extract 14 14) (|output_gate#318| state)) #b1) (= ((_ extract 15 15) (|output_gate#318| state)) #b1) (= ((_ extract 16 16) (|output_gate#318| state)) #b1) (= ((_ extract 17 17) (|output_gate#318| state)) #b1) (= ((_ extract 18 18) (|output_gate#318| state)) #b1) (= ((_ extract 19 19) (|output_gate#318| state)) #b1) (= ((_ extract 20 20) (|output_gate#318| state)) #b1) (= ((_ extract 21 21) (|output_gate#318| state)) #b1) (= ((_ extract 22 22) (|output_gate#318| state)) #b1) (= ((_ extract 23 23) (|output_gate#318| state)) #b1) (= ((_ extract 24 24) (|output_gate#318| state)) #b1) (= ((_ extract 25 25) (|output_gate#318| state)) #b1) (= ((_ extract 26 26) (|output_gate#318| state)) #b1) (= ((_ extract 27 27) (|output_gate#318| state)) #b1) (= ((_ extract 28 28) (|output_gate#318| state)) #b1) (= ((_ extract 29 29) (|output_gate#318| state)) #b1) (= ((_ extract 30 30) (|output_gate#318| state)) #b1) (= ((_ extract 31 31) (|output_gate#318| state)) #b1)))) ; $eq$output_gate_properties.vh:117$279_Y
(define-fun |output_gate_a 41| ((state |output_gate_s|)) Bool (or (|output_gate#319| state) (not (= ((_ extract 0 0) (|output_gate#146| state)) #b1)))) ; rest_is_kept
(define-fun |output_gate#320| ((state |output_gate_s|)) Bool (bvult (|output_gate#18| state) #b01111010000100100)) ; $lt$output_gate_properties.vh:136$349_Y
(define-fun |output_gate#321| ((state |output_gate_s|)) (_ BitVec 17) (bvsub #b01111010000100011 (|output_gate#18| state))) ; $sub$output_gate_properties.vh:136$350_Y
(define-fun |output_gate#322| ((state |output_gate_s|)) Bool (= (concat #b0 (|output_gate#150| state)) (|output_gate#321| state))) ; $eq$output_gate_properties.vh:136$351_Y
(define-fun |output_gate#323| ((state |output_gate_s|)) Bool (and (or  (|output_gate#320| state) false) (or  (|output_gate#322| state) false))) ; $logic_and$output_gate_properties.vh:136$352_Y
(define-fun |output_gate_a 42| ((state |output_gate_s|)) Bool (or (|output_gate#323| state) (not (= ((_ extract 0 0) (|output_gate#154| state)) #b1)))) ; settling_is_counted
(define-fun |output_gate#324| ((state |output_gate_s|)) (_ BitVec 33) (bvadd (concat #b0 (|output_gate#163| state)) (concat #b0 (|output_gate#175| state)))) ; $add$output_gate_properties.vh:133$332_Y
(define-fun |output_gate#325| ((state |output_gate_s|)) Bool (= (|output_gate#324| state) (|output_gate#195| state))) ; $eq$output_gate_properties.vh:133$334_Y
(define-fun |output_gate#326| ((state |output_gate_s|)) Bool (= (|output_gate#163| state) (|output_gate#99| state))) ; $eq$output_gate_properties.vh:133$331_Y
(define-fun |output_gate#327| ((state |output_gate_s|)) Bool (= (|output_gate#175| state) #b00000000000000000000000000000001)) ; $eq$output_gate_properties.vh:133$330_Y
(define-fun |output_gate#328| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#327| state) (ite (|output_gate#326| state) #b1 #b0) (ite (|output_gate#325| state) #b1 #b0))) ; $ternary$output_gate_properties.vh:133$335_Y
(define-fun |output_gate_a 43| ((state |output_gate_s|)) Bool (or (= ((_ extract 0 0) (|output_gate#328| state)) #b1) (not (= ((_ extract 0 0) (|output_gate#158| state)) #b1)))) ; silence_is_counted
(define-fun |output_gate_a 44| ((state |output_gate_s|)) Bool (or (= ((_ extract 1 1) (|output_gate#94| state)) #b1) (not (= ((_ extract 0 0) (|output_gate#162| state)) #b1)))) ; silence_is_kept
(define-fun |output_gate#329| ((state |output_gate_s|)) Bool (bvule (|output_gate#175| state) (|output_gate#99| state))) ; $le$output_gate_properties.vh:134$337_Y
(define-fun |output_gate#330| ((state |output_gate_s|)) Bool (or  (|output_gate#329| state) false  (|output_gate#327| state) false)) ; $logic_or$output_gate_properties.vh:134$339_Y
(define-fun |output_gate_a 45| ((state |output_gate_s|)) Bool (or (|output_gate#330| state) (not (= ((_ extract 0 0) (|output_gate#158| state)) #b1)))) ; silent_in_time
(define-fun |output_gate_a 46| ((state |output_gate_s|)) Bool (or (|output_gate#272| state) (not (= ((_ extract 0 0) (|output_gate#164| state)) #b1)))) ; silent_is_off
(define-fun |output_gate_a 47| ((state |output_gate_s|)) Bool (or (= ((_ extract 0 0) (|output_gate#94| state)) #b1) (not (= ((_ extract 0 0) (|output_gate#167| state)) #b1)))) ; stop_is_kept
(define-fun |output_gate_a 48| ((state |output_gate_s|)) Bool (or (|output_gate#272| state) (not (= ((_ extract 0 0) (|output_gate#168| state)) #b1)))) ; stopped_is_off
(define-fun |output_gate#331| ((state |output_gate_s|)) Bool (bvuge (|output_gate#176| state) #b01111010000100100)) ; $ge$output_gate_properties.vh:121$287_Y
(define-fun |output_gate#332| ((state |output_gate_s|)) Bool (or  (|output_gate#290| state) false  (|output_gate#331| state) false)) ; $logic_or$output_gate_properties.vh:121$288_Y
(define-fun |output_gate_a 49| ((state |output_gate_s|)) Bool (or (|output_gate#332| state) (not (= ((_ extract 0 0) (|output_gate#113| state)) #b1)))) ; supply_has_settled
(define-fun |output_gate_a 50| ((state |output_gate_s|)) Bool (or (= ((_ extract 3 3) (|output_gate#94| state)) #b1) (not (= ((_ extract 0 0) (|output_gate#172| state)) #b1)))) ; underrun_is_kept
(define-fun |output_gate_a 51| ((state |output_gate_s|)) Bool (or (|output_gate#272| state) (not (= ((_ extract 0 0) (|output_gate#173| state)) #b1)))) ; underrun_is_off
(define-fun |output_gate#333| ((state |output_gate_s|)) (_ BitVec 17) (bvadd (|output_gate#176| state) #b00000000000000001)) ; $add$output_gate_properties.vh:14$140_Y
(define-fun |output_gate#334| ((state |output_gate_s|)) Bool (= (|output_gate#176| state) #b01111010000100100)) ; $eq$output_gate_properties.vh:14$139_Y
(define-fun |output_gate#335| ((state |output_gate_s|)) (_ BitVec 17) (ite (|output_gate#334| state) #b01111010000100100 (|output_gate#333| state))) ; $0\longer$func$output_gate_properties.vh:60$2.$result[16:0]$111
(define-fun |output_gate#336| ((state |output_gate_s|)) Bool (or  (|output_gate#149| state) false  (|output_gate#292| state) false)) ; $logic_or$output_gate_properties.vh:60$143_Y
(define-fun |output_gate#337| ((state |output_gate_s|)) (_ BitVec 17) (ite (|output_gate#336| state) #b00000000000000000 (|output_gate#335| state))) ; $0\up_q[16:0]
(define-fun |output_gate#338| ((state |output_gate_s|)) (_ BitVec 32) (bvadd (|output_gate#175| state) #b00000000000000000000000000000001)) ; $add$output_gate_properties.vh:74$168_Y
(define-fun |output_gate#339| ((state |output_gate_s|)) Bool (= (|output_gate#175| state) #b11111111111111111111111111111111)) ; $eq$output_gate_properties.vh:74$167_Y
(define-fun |output_gate#340| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#339| state) (|output_gate#175| state) (|output_gate#338| state))) ; $ternary$output_gate_properties.vh:74$169_Y
(define-fun |output_gate#341| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#101| state) #b00000000000000000000000000000001 (|output_gate#340| state))) ; $0\unfed_q[31:0]
(define-fun |output_gate#342| ((state |output_gate_s|)) (_ BitVec 32) (bvadd (|output_gate#174| state) #b00000000000000000000000000000001)) ; $add$output_gate.v:122$44_Y
(define-fun |output_gate#343| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 0 0) (|output_gate#51| state)) #b1) false) (or  (= ((_ extract 0 0) (|output_gate#50| state)) #b1) false))) ; $logic_and$output_gate.v:122$43_Y
(define-fun |output_gate#344| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#343| state) (|output_gate#342| state) (|output_gate#174| state))) ; $procmux$449_Y
(define-fun |output_gate#345| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#149| state) #b00000000000000000000000000000000 (|output_gate#344| state))) ; $0\underruns_q[31:0]
(define-fun |output_gate#346| ((state |output_gate_s|)) (_ BitVec 32) (bvsub (|output_gate#163| state) #b00000000000000000000000000000001)) ; $sub$output_gate.v:105$30_Y
(define-fun |output_gate#347| ((state |output_gate_s|)) (_ BitVec 32) (ite (= ((_ extract 0 0) (|output_gate#20| state)) #b1) (|output_gate#163| state) (|output_gate#346| state))) ; $procmux$478_Y
(define-fun |output_gate#348| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#101| state) (|output_gate#102| state) (|output_gate#347| state))) ; $procmux$481_Y
(define-fun |output_gate#349| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#149| state) #b00000000000000000000000000000000 (|output_gate#348| state))) ; $0\silence_q[31:0]
(define-fun |output_gate#350| ((state |output_gate_s|)) (_ BitVec 16) (bvsub (|output_gate#150| state) #b0000000000000001)) ; $sub$output_gate.v:135$46_Y
(define-fun |output_gate#351| ((state |output_gate_s|)) (_ BitVec 16) (ite (|output_gate#81| state) (|output_gate#350| state) #b1111010000100011)) ; $ternary$output_gate.v:135$47_Y
(define-fun |output_gate#352| ((state |output_gate_s|)) (_ BitVec 16) (ite (|output_gate#149| state) #b0000000000000000 (|output_gate#351| state))) ; $0\settle_left_q[15:0]
(define-fun |output_gate#353| ((state |output_gate_s|)) (_ BitVec 32) (bvsub (|output_gate#147| state) #b00000000000000000000000000000001)) ; $sub$output_gate.v:115$38_Y
(define-fun |output_gate#354| ((state |output_gate_s|)) (_ BitVec 32) (ite (= ((_ extract 0 0) (|output_gate#139| state)) #b1) (|output_gate#353| state) (|output_gate#147| state))) ; $procmux$464_Y
(define-fun |output_gate#355| ((state |output_gate_s|)) Bool (distinct ((_ extract 8 4) (|output_gate#52| state)) #b00000)) ; $ne$output_gate.v:111$37_Y
(define-fun |output_gate#356| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#355| state) #b00000000111011100110101100101000 (|output_gate#354| state))) ; $procmux$467_Y
(define-fun |output_gate#357| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#149| state) #b00000000000000000000000000000000 (|output_gate#356| state))) ; $0\rest_left_q[31:0]
(define-fun |output_gate#358| ((state |output_gate_s|)) Bool (distinct (|output_gate#147| state) #b00000000000000000000000000000001)) ; $ne$output_gate.v:116$39_Y
(define-fun |output_gate#359| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#139| state)) #b1) (ite (|output_gate#358| state) #b1 #b0) #b0)) ; $procmux$457_Y
(define-fun |output_gate#360| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#355| state) #b1 (|output_gate#359| state))) ; $procmux$460_Y
(define-fun |output_gate#361| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#149| state) #b0 (|output_gate#360| state))) ; $0\resting_q[0:0]
(define-fun |output_gate#362| ((state |output_gate_s|)) (_ BitVec 3) (bvand (concat ((_ extract 1 0) (|output_gate#123| state)) (ite (|output_gate#88| state) #b1 #b0)) (concat (ite (|output_gate#133| state) #b1 #b0) (concat (ite (|output_gate#133| state) #b1 #b0) (ite (|output_gate#133| state) #b1 #b0))))) ; $and$output_gate.v:136$48_Y
(define-fun |output_gate#363| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#149| state) #b000 (|output_gate#362| state))) ; $0\on_later_q[2:0]
(define-fun |output_gate#364| ((state |output_gate_s|)) (_ BitVec 3) (bvand (concat ((_ extract 1 0) (|output_gate#114| state)) (ite (|output_gate#87| state) #b1 #b0)) (concat (ite (|output_gate#133| state) #b1 #b0) (concat (ite (|output_gate#133| state) #b1 #b0) (ite (|output_gate#133| state) #b1 #b0))))) ; $and$output_gate.v:137$49_Y
(define-fun |output_gate#365| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#149| state) #b000 (|output_gate#364| state))) ; $0\moves_later_q[2:0]
(define-fun |output_gate#366| ((state |output_gate_s|)) (_ BitVec 16) (bvsub (|output_gate#100| state) #b0000000000000001)) ; $sub$output_gate.v:143$61_Y
(define-fun |output_gate#367| ((state |output_gate_s|)) Bool (distinct (|output_gate#100| state) #b0000000000000000)) ; $ne$output_gate.v:143$60_Y
(define-fun |output_gate#368| ((state |output_gate_s|)) (_ BitVec 16) (ite (|output_gate#367| state) (|output_gate#366| state) (|output_gate#100| state))) ; $procmux$435_Y
(define-fun |output_gate#369| ((state |output_gate_s|)) (_ BitVec 16) (bvsub (|output_gate#45| state) #b0000000000000001)) ; $sub$output_gate.v:142$59_Y
(define-fun |output_gate#370| ((state |output_gate_s|)) (_ BitVec 16) (ite (|output_gate#80| state) (|output_gate#369| state) (|output_gate#368| state))) ; $procmux$438_Y
(define-fun |output_gate#371| ((state |output_gate_s|)) (_ BitVec 16) (ite (|output_gate#134| state) (|output_gate#370| state) #b0000000000000000)) ; $procmux$441_Y
(define-fun |output_gate#372| ((state |output_gate_s|)) (_ BitVec 16) (ite (|output_gate#149| state) #b0000000000000000 (|output_gate#371| state))) ; $0\focus_left_q[15:0]
(define-fun |output_gate#373| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#101| state) (|output_gate#102| state) (|output_gate#99| state))) ; $0\fed_ticks_q[31:0]
(define-fun |output_gate#374| ((state |output_gate_s|)) Bool (not (or  (|output_gate#149| state) false))) ; $logic_not$output_gate.v:177$67_Y
(define-fun |output_gate#375| ((state |output_gate_s|)) Bool (or  (= ((_ extract 0 0) (|output_gate#98| state)) #b1) false  (|output_gate#101| state) false)) ; $logic_or$output_gate_properties.vh:72$164_Y
(define-fun |output_gate#376| ((state |output_gate_s|)) Bool (and (or  (|output_gate#374| state) false) (or  (|output_gate#375| state) false))) ; $0\fed_q[0:0]
(define-fun |output_gate#377| ((state |output_gate_s|)) Bool (distinct (|output_gate#148| state) #b000000000)) ; $ne$output_gate.v:110$34_Y
(define-fun |output_gate#378| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#55| state) (ite (|output_gate#377| state) #b1 #b0) (|output_gate#96| state))) ; $ternary$output_gate.v:110$35_Y
(define-fun |output_gate#379| ((state |output_gate_s|)) Bool (or  (= ((_ extract 0 0) (|output_gate#378| state)) #b1) false  (|output_gate#155| state) false)) ; $logic_or$output_gate.v:110$36_Y
(define-fun |output_gate#380| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#149| state) #b0 (ite (|output_gate#379| state) #b1 #b0))) ; $0\faulted_q[0:0]
(define-fun |output_gate#381| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#96| state)) #b1) false))) ; $logic_not$output_gate.v:118$40_Y
(define-fun |output_gate#382| ((state |output_gate_s|)) Bool (and (or  (|output_gate#155| state) false) (or  (|output_gate#381| state) false))) ; $logic_and$output_gate.v:118$41_Y
(define-fun |output_gate#383| ((state |output_gate_s|)) (_ BitVec 64) (ite (|output_gate#382| state) (|output_gate#122| state) (|output_gate#95| state))) ; $procmux$445_Y
(define-fun |output_gate#384| ((state |output_gate_s|)) (_ BitVec 64) (ite (|output_gate#149| state) #b0000000000000000000000000000000000000000000000000000000000000000 (|output_gate#383| state))) ; $0\fault_time_q[63:0]
(define-fun |output_gate#385| ((state |output_gate_s|)) (_ BitVec 9) (ite (|output_gate#55| state) (|output_gate#148| state) (|output_gate#94| state))) ; $ternary$output_gate.v:109$32_Y
(define-fun |output_gate#386| ((state |output_gate_s|)) (_ BitVec 9) (bvor (|output_gate#385| state) (|output_gate#52| state))) ; $or$output_gate.v:109$33_Y
(define-fun |output_gate#387| ((state |output_gate_s|)) (_ BitVec 9) (ite (|output_gate#149| state) #b000000000 (|output_gate#386| state))) ; $0\fault_q[8:0]
(define-fun |output_gate#388| ((state |output_gate_s|)) (_ BitVec 32) (bvadd (|output_gate#93| state) #b00000000000000000000000000000001)) ; $add$output_gate.v:119$42_Y
(define-fun |output_gate#389| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#382| state) (|output_gate#388| state) (|output_gate#93| state))) ; $procmux$453_Y
(define-fun |output_gate#390| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#149| state) #b00000000000000000000000000000000 (|output_gate#389| state))) ; $0\fault_count_q[31:0]
(define-fun |output_gate#391| ((state |output_gate_s|)) Bool (bvule (|output_gate#39| state) #b101)) ; $0\exists_1_q[0:0]
(define-fun |output_gate#392| ((state |output_gate_s|)) (_ BitVec 32) (bvadd (|output_gate#79| state) #b00000000000000000000000000000001)) ; $add$output_gate.v:140$57_Y
(define-fun |output_gate#393| ((state |output_gate_s|)) Bool (and (or  (|output_gate#80| state) false) (or  (|output_gate#134| state) false))) ; $logic_and$output_gate.v:140$56_Y
(define-fun |output_gate#394| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#393| state) (|output_gate#392| state) (|output_gate#79| state))) ; $procmux$431_Y
(define-fun |output_gate#395| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#149| state) #b00000000000000000000000000000000 (|output_gate#394| state))) ; $0\emissions_q[31:0]
(define-fun |output_gate#396| ((state |output_gate_s|)) Bool (not (or  (|output_gate#38| state) false))) ; $logic_not$output_gate_properties.vh:71$157_Y
(define-fun |output_gate#397| ((state |output_gate_s|)) Bool (and (or  (|output_gate#374| state) false) (or  (|output_gate#396| state) false))) ; $logic_and$output_gate_properties.vh:71$158_Y
(define-fun |output_gate#398| ((state |output_gate_s|)) Bool (not (or  (|output_gate#89| state) false))) ; $logic_not$output_gate_properties.vh:71$159_Y
(define-fun |output_gate#399| ((state |output_gate_s|)) Bool (and (or  (|output_gate#62| state) false) (or  (|output_gate#398| state) false))) ; $logic_and$output_gate_properties.vh:71$160_Y
(define-fun |output_gate#400| ((state |output_gate_s|)) Bool (or  (= ((_ extract 0 0) (|output_gate#68| state)) #b1) false  (|output_gate#399| state) false)) ; $logic_or$output_gate_properties.vh:71$161_Y
(define-fun |output_gate#401| ((state |output_gate_s|)) Bool (and (or  (|output_gate#397| state) false) (or  (|output_gate#400| state) false))) ; $0\disarmed_q[0:0]
(define-fun |output_gate#402| ((state |output_gate_s|)) Bool (not (or  (|output_gate#155| state) false))) ; $logic_not$output_gate.v:138$50_Y
(define-fun |output_gate#403| ((state |output_gate_s|)) Bool (and (or  (|output_gate#38| state) false) (or  (|output_gate#402| state) false))) ; $logic_and$output_gate.v:138$51_Y
(define-fun |output_gate#404| ((state |output_gate_s|)) Bool (and (or  (|output_gate#133| state) false) (or  (|output_gate#283| state) false))) ; $logic_and$output_gate.v:138$54_Y
(define-fun |output_gate#405| ((state |output_gate_s|)) Bool (or  (|output_gate#403| state) false  (|output_gate#404| state) false)) ; $logic_or$output_gate.v:138$55_Y
(define-fun |output_gate#406| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#149| state) #b0 (ite (|output_gate#405| state) #b1 #b0))) ; $0\live_q[0:0]
(define-fun |output_gate#407| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#136| state) #b000 (|output_gate#39| state))) ; $procmux$486_Y
(define-fun |output_gate#408| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#151| state) #b100 (|output_gate#39| state))) ; $procmux$490_Y
(define-fun |output_gate#409| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#62| state) #b011 (|output_gate#39| state))) ; $procmux$493_Y
(define-fun |output_gate#410| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#136| state) #b010 (|output_gate#39| state))) ; $procmux$496_Y
(define-fun |output_gate#411| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#62| state) #b100 (|output_gate#410| state))) ; $procmux$499_Y
(define-fun |output_gate#412| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#150| state)) #b1) (= ((_ extract 1 1) (|output_gate#150| state)) #b1) (= ((_ extract 2 2) (|output_gate#150| state)) #b1) (= ((_ extract 3 3) (|output_gate#150| state)) #b1) (= ((_ extract 4 4) (|output_gate#150| state)) #b1) (= ((_ extract 5 5) (|output_gate#150| state)) #b1) (= ((_ extract 6 6) (|output_gate#150| state)) #b1) (= ((_ extract 7 7) (|output_gate#150| state)) #b1) (= ((_ extract 8 8) (|output_gate#150| state)) #b1) (= ((_ extract 9 9) (|output_gate#150| state)) #b1) (= ((_ extract 10 10) (|output_gate#150| state)) #b1) (= ((_ extract 11 11) (|output_gate#150| state)) #b1) (= ((_ extract 12 12) (|output_gate#150| state)) #b1) (= ((_ extract 13 13) (|output_gate#150| state)) #b1) (= ((_ extract 14 14) (|output_gate#150| state)) #b1) (= ((_ extract 15 15) (|output_gate#150| state)) #b1)))) ; $eq$output_gate.v:126$45_Y
(define-fun |output_gate#413| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#412| state) #b001 (|output_gate#39| state))) ; $procmux$502_Y
(define-fun |output_gate#414| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#62| state) #b000 (|output_gate#413| state))) ; $procmux$505_Y
(define-fun |output_gate#415| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#38| state) #b101 (|output_gate#39| state))) ; $procmux$508_Y
(define-fun |output_gate#416| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#89| state) (|output_gate#415| state) (ite (|output_gate#81| state) (|output_gate#414| state) (ite (|output_gate#82| state) (|output_gate#411| state) (ite (|output_gate#40| state) (|output_gate#409| state) (ite (|output_gate#84| state) (|output_gate#408| state) (ite (|output_gate#86| state) (|output_gate#407| state) #b000))))))) ; $procmux$488_Y
(define-fun |output_gate#417| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#155| state) #b000 (|output_gate#416| state))) ; $procmux$511_Y
(define-fun |output_gate#418| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#149| state) #b000 (|output_gate#417| state))) ; $0\state_q[2:0]
(define-fun |output_gate#419| ((state |output_gate_s|)) Bool (and (or  (|output_gate#134| state) false) (or  (|output_gate#374| state) false))) ; $0\hv_enable_q[0:0]
(define-fun |output_gate#420| ((state |output_gate_s|)) Bool (or  (|output_gate#80| state) false  (|output_gate#367| state) false)) ; $logic_or$output_gate.v:180$81_Y
(define-fun |output_gate#421| ((state |output_gate_s|)) Bool (and (or  (|output_gate#419| state) false) (or  (|output_gate#420| state) false))) ; $0\focus_q[0:0]
(define-fun |output_gate#422| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#23| state)) #b1) #b0 (ite (|output_gate#421| state) #b1 #b0))) ; $auto$rtlil.cc:3381:Mux$1345
(define-fun |output_gate#423| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#19| state)) #b1) (= ((_ extract 1 1) (|output_gate#19| state)) #b1) (= ((_ extract 2 2) (|output_gate#19| state)) #b1) (= ((_ extract 3 3) (|output_gate#19| state)) #b1) (= ((_ extract 4 4) (|output_gate#19| state)) #b1) (= ((_ extract 5 5) (|output_gate#19| state)) #b1) (= ((_ extract 6 6) (|output_gate#19| state)) #b1) (= ((_ extract 7 7) (|output_gate#19| state)) #b1) (= ((_ extract 8 8) (|output_gate#19| state)) #b1) (= ((_ extract 9 9) (|output_gate#19| state)) #b1) (= ((_ extract 10 10) (|output_gate#19| state)) #b1)))) ; $eq$output_gate.v:145$63_Y
(define-fun |output_gate#424| ((state |output_gate_s|)) (_ BitVec 1) (bvxor (|output_gate#30| state) (ite (|output_gate#423| state) #b1 #b0))) ; $xor$output_gate.v:179$76_Y
(define-fun |output_gate#425| ((state |output_gate_s|)) Bool (and (or  (|output_gate#419| state) false) (or  (= ((_ extract 0 0) (|output_gate#424| state)) #b1) false))) ; $0\hv_alive_q[0:0]
(define-fun |output_gate#426| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#23| state)) #b1) #b0 (ite (|output_gate#425| state) #b1 #b0))) ; $auto$rtlil.cc:3381:Mux$1343
(define-fun |output_gate#427| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#23| state)) #b1) #b0 (ite (|output_gate#419| state) #b1 #b0))) ; $auto$rtlil.cc:3381:Mux$1347
(define-fun |output_gate#428| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 0 0) (|output_gate#22| state)) #b1) false) (or  (|output_gate#46| state) false))) ; $logic_and$output_gate_properties.vh:70$147_Y
(define-fun |output_gate#429| ((state |output_gate_s|)) Bool (and (or  (|output_gate#428| state) false) (or  (|output_gate#48| state) false))) ; $logic_and$output_gate_properties.vh:70$148_Y
(define-fun |output_gate#430| ((state |output_gate_s|)) Bool (and (or  (|output_gate#429| state) false) (or  (|output_gate#21| state) false))) ; $logic_and$output_gate_properties.vh:70$149_Y
(define-fun |output_gate#431| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 1 1) (|output_gate#50| state)) #b1) (= ((_ extract 2 2) (|output_gate#50| state)) #b1) (= ((_ extract 3 3) (|output_gate#50| state)) #b1) (= ((_ extract 4 4) (|output_gate#50| state)) #b1) (= ((_ extract 5 5) (|output_gate#50| state)) #b1)))) ; $eq$output_gate_properties.vh:70$150_Y
(define-fun |output_gate#432| ((state |output_gate_s|)) Bool (and (or  (|output_gate#430| state) false) (or  (|output_gate#431| state) false))) ; $logic_and$output_gate_properties.vh:70$151_Y
(define-fun |output_gate#433| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#50| state)) #b1) false))) ; $logic_not$output_gate_properties.vh:70$152_Y
(define-fun |output_gate#434| ((state |output_gate_s|)) Bool (and (or  (|output_gate#432| state) false) (or  (|output_gate#433| state) false))) ; $logic_and$output_gate_properties.vh:70$153_Y
(define-fun |output_gate#435| ((state |output_gate_s|)) Bool (or  (|output_gate#38| state) false  (|output_gate#434| state) false)) ; $logic_or$output_gate_properties.vh:70$154_Y
(define-fun |output_gate#436| ((state |output_gate_s|)) Bool (and (or  (|output_gate#374| state) false) (or  (|output_gate#435| state) false))) ; $0\allowed_q[0:0]
(define-fun |output_gate#437| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 1 1) (|output_gate#163| state)) #b1) (= ((_ extract 2 2) (|output_gate#163| state)) #b1) (= ((_ extract 3 3) (|output_gate#163| state)) #b1) (= ((_ extract 4 4) (|output_gate#163| state)) #b1) (= ((_ extract 5 5) (|output_gate#163| state)) #b1) (= ((_ extract 6 6) (|output_gate#163| state)) #b1) (= ((_ extract 7 7) (|output_gate#163| state)) #b1) (= ((_ extract 8 8) (|output_gate#163| state)) #b1) (= ((_ extract 9 9) (|output_gate#163| state)) #b1) (= ((_ extract 10 10) (|output_gate#163| state)) #b1) (= ((_ extract 11 11) (|output_gate#163| state)) #b1) (= ((_ extract 12 12) (|output_gate#163| state)) #b1) (= ((_ extract 13 13) (|output_gate#163| state)) #b1) (= ((_ extract 14 14) (|output_gate#163| state)) #b1) (= ((_ extract 15 15) (|output_gate#163| state)) #b1) (= ((_ extract 16 16) (|output_gate#163| state)) #b1) (= ((_ extract 17 17) (|output_gate#163| state)) #b1) (= ((_ extract 18 18) (|output_gate#163| state)) #b1) (= ((_ extract 19 19) (|output_gate#163| state)) #b1) (= ((_ extract 20 20) (|output_gate#163| state)) #b1) (= ((_ extract 21 21) (|output_gate#163| state)) #b1) (= ((_ extract 22 22) (|output_gate#163| state)) #b1) (= ((_ extract 23 23) (|output_gate#163| state)) #b1) (= ((_ extract 24 24) (|output_gate#163| state)) #b1) (= ((_ extract 25 25) (|output_gate#163| state)) #b1) (= ((_ extract 26 26) (|output_gate#163| state)) #b1) (= ((_ extract 27 27) (|output_gate#163| state)) #b1) (= ((_ extract 28 28) (|output_gate#163| state)) #b1) (= ((_ extract 29 29) (|output_gate#163| state)) #b1) (= ((_ extract 30 30) (|output_gate#163| state)) #b1) (= ((_ extract 31 31) (|output_gate#163| state)) #b1)))) ; $eq$output_gate.v:106$31_Y
(define-fun |output_gate#438| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#20| state)) #b1) #b1 (ite (|output_gate#437| state) #b1 #b0))) ; $procmux$471_Y
(define-fun |output_gate#439| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#101| state) #b0 (|output_gate#438| state))) ; $procmux$474_Y
(define-fun |output_gate#440| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#149| state) #b1 (|output_gate#439| state))) ; $0\silent_q[0:0]
(define-fun |output_gate#441| ((state |output_gate_s|)) (_ BitVec 11) (bvsub (|output_gate#19| state) #b00000000001)) ; $sub$output_gate.v:146$64_Y
(define-fun |output_gate#442| ((state |output_gate_s|)) (_ BitVec 11) (ite (|output_gate#423| state) #b11111001111 (|output_gate#441| state))) ; $procmux$412_Y
(define-fun |output_gate#443| ((state |output_gate_s|)) (_ BitVec 11) (ite (|output_gate#134| state) (|output_gate#442| state) #b00000000000)) ; $procmux$415_Y
(define-fun |output_gate#444| ((state |output_gate_s|)) (_ BitVec 11) (ite (|output_gate#149| state) #b00000000000 (|output_gate#443| state))) ; $0\alive_left_q[10:0]
(define-fun |output_gate#445| ((state |output_gate_s|)) (_ BitVec 17) (bvadd (|output_gate#18| state) #b00000000000000001)) ; $add$output_gate_properties.vh:14$115_Y
(define-fun |output_gate#446| ((state |output_gate_s|)) (_ BitVec 17) (ite (|output_gate#289| state) #b01111010000100100 (|output_gate#445| state))) ; $0\longer$func$output_gate_properties.vh:55$1.$result[16:0]$109
(define-fun |output_gate#447| ((state |output_gate_s|)) Bool (not (or  (|output_gate#133| state) false))) ; $logic_not$output_gate_properties.vh:55$117_Y
(define-fun |output_gate#448| ((state |output_gate_s|)) Bool (or  (|output_gate#149| state) false  (|output_gate#447| state) false)) ; $logic_or$output_gate_properties.vh:55$118_Y
(define-fun |output_gate#449| ((state |output_gate_s|)) Bool (not (or  (|output_gate#88| state) false))) ; $logic_not$output_gate_properties.vh:55$119_Y
(define-fun |output_gate#450| ((state |output_gate_s|)) Bool (or  (|output_gate#448| state) false  (|output_gate#449| state) false)) ; $logic_or$output_gate_properties.vh:55$120_Y
(define-fun |output_gate#451| ((state |output_gate_s|)) (_ BitVec 17) (ite (|output_gate#450| state) #b00000000000000000 (|output_gate#446| state))) ; $0\age_q[16:0]
(define-fun |output_gate#452| ((state |output_gate_s|)) (_ BitVec 17) (ite (|output_gate#448| state) #b00000000000000000 (|output_gate#16| state))) ; $0\age_4_q[16:0]
(define-fun |output_gate#453| ((state |output_gate_s|)) (_ BitVec 17) (ite (|output_gate#448| state) #b00000000000000000 (|output_gate#15| state))) ; $0\age_3_q[16:0]
(define-fun |output_gate#454| ((state |output_gate_s|)) (_ BitVec 17) (ite (|output_gate#448| state) #b00000000000000000 (|output_gate#14| state))) ; $0\age_2_q[16:0]
(define-fun |output_gate#455| ((state |output_gate_s|)) (_ BitVec 17) (ite (|output_gate#448| state) #b00000000000000000 (|output_gate#18| state))) ; $0\age_1_q[16:0]
(define-fun |output_gate#456| ((state |output_gate_s|)) (_ BitVec 32) (bvadd (|output_gate#10| state) #b00000000000000000000000000000001)) ; $add$output_gate_properties.vh:75$176_Y
(define-fun |output_gate#457| ((state |output_gate_s|)) Bool (= (|output_gate#10| state) #b00000000111011100110101100101000)) ; $eq$output_gate_properties.vh:75$175_Y
(define-fun |output_gate#458| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#457| state) #b00000000111011100110101100101000 (|output_gate#456| state))) ; $ternary$output_gate_properties.vh:75$177_Y
(define-fun |output_gate#459| ((state |output_gate_s|)) Bool (distinct ((_ extract 5 1) (|output_gate#50| state)) #b00000)) ; $ne$output_gate_properties.vh:75$171_Y
(define-fun |output_gate#460| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 0 0) (|output_gate#51| state)) #b1) false) (or  (|output_gate#459| state) false))) ; $logic_and$output_gate_properties.vh:75$172_Y
(define-fun |output_gate#461| ((state |output_gate_s|)) Bool (or  false (= ((_ extract 2 2) (|output_gate#50| state)) #b1) (= ((_ extract 3 3) (|output_gate#50| state)) #b1) false false)) ; $ne$output_gate_properties.vh:75$173_Y
(define-fun |output_gate#462| ((state |output_gate_s|)) Bool (or  (|output_gate#460| state) false  (|output_gate#461| state) false)) ; $logic_or$output_gate_properties.vh:75$174_Y
(define-fun |output_gate#463| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#462| state) #b00000000000000000000000000000000 (|output_gate#458| state))) ; $ternary$output_gate_properties.vh:75$178_Y
(define-fun |output_gate#464| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#149| state) #b00000000111011100110101100101000 (|output_gate#463| state))) ; $0\since_limit_q[31:0]
(define-fun |output_gate#465| ((state |output_gate_s|)) (_ BitVec 32) (bvand (|output_gate#72| state) (|output_gate#53| state))) ; $and$output_gate.v:177$69_Y
(define-fun |output_gate#466| ((state |output_gate_s|)) Bool (and (or  (|output_gate#134| state) false) (or  (= ((_ extract 2 2) (|output_gate#114| state)) #b1) false))) ; $logic_and$output_gate.v:177$66_Y
(define-fun |output_gate#467| ((state |output_gate_s|)) Bool (and (or  (|output_gate#466| state) false) (or  (|output_gate#374| state) false))) ; $logic_and$output_gate.v:177$68_Y
(define-fun |output_gate#468| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#467| state) (|output_gate#465| state) #b00000000000000000000000000000000)) ; $0\channel_q[31:0]
(define-fun |output_gate#469| ((state |output_gate_s|)) (_ BitVec 32) (ite (= ((_ extract 0 0) (|output_gate#23| state)) #b1) #b00000000000000000000000000000000 (|output_gate#468| state))) ; $auto$rtlil.cc:3381:Mux$1349
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
  (= (|output_gate#337| state) (|output_gate#176| next_state)) ; $procdff$1033 \up_q
  (= (|output_gate#341| state) (|output_gate#175| next_state)) ; $procdff$1037 \unfed_q
  (= (|output_gate#345| state) (|output_gate#174| next_state)) ; $procdff$996 \underruns_q
  (= ((_ extract 0 0) (|output_gate#50| state)) (|output_gate#169| next_state)) ; $procdff$1044 \underrun_1_q
  (= (|output_gate#349| state) (|output_gate#163| next_state)) ; $procdff$989 \silence_q
  (= (|output_gate#20| state) (|output_gate#159| next_state)) ; $procdff$1021 \silent_1_q
  (= (|output_gate#352| state) (|output_gate#150| next_state)) ; $procdff$998 \settle_left_q
  (= (|output_gate#357| state) (|output_gate#147| next_state)) ; $procdff$993 \rest_left_q
  (= (|output_gate#139| state) (|output_gate#143| next_state)) ; $procdff$1027 \resting_1_q
  (= (|output_gate#361| state) (|output_gate#139| next_state)) ; $procdff$994 \resting_q
  (= (ite (|output_gate#46| state) #b1 #b0) (|output_gate#135| next_state)) ; $procdff$1019 \permit_1_q
  (= (|output_gate#363| state) (|output_gate#123| next_state)) ; $procdff$999 \on_later_q
  (= (|output_gate#122| state) (|output_gate#121| next_state)) ; $procdff$1049 \now_1_q
  (= (|output_gate#365| state) (|output_gate#114| next_state)) ; $procdff$1000 \moves_later_q
  (= (|output_gate#53| state) (|output_gate#112| next_state)) ; $procdff$1023 \mask_1_q
  (= (|output_gate#27| state) (|output_gate#104| next_state)) ; $procdff$1026 \hv_1_q
  (= (|output_gate#372| state) (|output_gate#100| next_state)) ; $procdff$1002 \focus_left_q
  (= (|output_gate#373| state) (|output_gate#99| next_state)) ; $procdff$1036 \fed_ticks_q
  (= (ite (|output_gate#376| state) #b1 #b0) (|output_gate#98| next_state)) ; $procdff$1038 \fed_q
  (= ((_ extract 8 4) (|output_gate#94| state)) (|output_gate#97| next_state)) ; $procdff$1025 \faults_1_q
  (= (|output_gate#380| state) (|output_gate#96| next_state)) ; $procdff$992 \faulted_q
  (= (|output_gate#384| state) (|output_gate#95| next_state)) ; $procdff$997 \fault_time_q
  (= (|output_gate#387| state) (|output_gate#94| next_state)) ; $procdff$991 \fault_q
  (= (|output_gate#390| state) (|output_gate#93| next_state)) ; $procdff$995 \fault_count_q
  (= (|output_gate#93| state) (|output_gate#92| next_state)) ; $procdff$1048 \fault_count_1_q
  (= (ite (|output_gate#391| state) #b1 #b0) (|output_gate#91| next_state)) ; $procdff$1022 \exists_1_q
  (= (|output_gate#395| state) (|output_gate#79| next_state)) ; $procdff$1003 \emissions_q
  (= (concat #b00 (concat ((_ extract 3 2) (|output_gate#50| state)) #b0)) (|output_gate#73| next_state)) ; $procdff$1040 \edges_1_q
  (= (|output_gate#72| state) (|output_gate#71| next_state)) ; $procdff$1047 \drive_1_q
  (= (ite (|output_gate#401| state) #b1 #b0) (|output_gate#68| next_state)) ; $procdff$1035 \disarmed_q
  (= (ite (|output_gate#62| state) #b1 #b0) (|output_gate#61| next_state)) ; $procdff$1042 \disarm_1_q
  (= (ite (|output_gate#48| state) #b1 #b0) (|output_gate#57| next_state)) ; $procdff$1020 \cool_1_q
  (= (ite (|output_gate#55| state) #b1 #b0) (|output_gate#54| next_state)) ; $procdff$1043 \clear_1_q
  (= (|output_gate#406| state) (|output_gate#51| next_state)) ; $procdff$1001 \live_q
  (= ((_ extract 5 1) (|output_gate#50| state)) (|output_gate#41| next_state)) ; $procdff$1024 \limits_1_q
  (= (|output_gate#418| state) (|output_gate#39| next_state)) ; $procdff$988 \state_q
  (= (ite (|output_gate#38| state) #b1 #b0) (|output_gate#37| next_state)) ; $procdff$1041 \arm_1_q
  (= (|output_gate#422| state) (|output_gate#32| next_state)) ; $procdff$1013 \_witness_.anyinit_procdff_1013
  (= (|output_gate#426| state) (|output_gate#29| next_state)) ; $procdff$1016 \_witness_.anyinit_procdff_1016
  (= (|output_gate#427| state) (|output_gate#26| next_state)) ; $procdff$1010 \_witness_.anyinit_procdff_1010
  (= (ite (|output_gate#436| state) #b1 #b0) (|output_gate#22| next_state)) ; $procdff$1034 \allowed_q
  (= (|output_gate#440| state) (|output_gate#20| next_state)) ; $procdff$990 \silent_q
  (= (|output_gate#444| state) (|output_gate#19| next_state)) ; $procdff$1004 \alive_left_q
  (= (|output_gate#451| state) (|output_gate#18| next_state)) ; $procdff$1028 \age_q
  (= (|output_gate#452| state) (|output_gate#17| next_state)) ; $procdff$1032 \age_4_q
  (= (|output_gate#453| state) (|output_gate#16| next_state)) ; $procdff$1031 \age_3_q
  (= (|output_gate#454| state) (|output_gate#15| next_state)) ; $procdff$1030 \age_2_q
  (= (|output_gate#455| state) (|output_gate#14| next_state)) ; $procdff$1029 \age_1_q
  (= (|output_gate#464| state) (|output_gate#10| next_state)) ; $procdff$1039 \since_limit_q
  (= #b1 (|output_gate#8| next_state)) ; $procdff$1017 \started_q
  (= (ite (|output_gate#149| state) #b1 #b0) (|output_gate#6| next_state)) ; $procdff$1018 \rst_1_q
  (= (concat #b0000000 (|output_gate#94| state)) (|output_gate#2| next_state)) ; $procdff$1046 \all_faults_1_q
  (= (ite (|output_gate#155| state) #b1 #b0) (|output_gate#1| next_state)) ; $procdff$1045 \shut_1_q
  (= (|output_gate#469| state) (|output_gate#0| next_state)) ; $procdff$1007 \_witness_.anyinit_procdff_1007
)) ; end of module output_gate
