; of 22aff5bdc88aec704df43e8a09d9ade07efe850ce8a3fb81252761188075a687, by python -m tests.rtl.proofs
(declare-sort |output_gate_s| 0)
(declare-fun |output_gate_is| (|output_gate_s|) Bool)
(declare-fun |output_gate#0| (|output_gate_s|) (_ BitVec 32)) ; \_witness_.anyinit_procdff_362
(define-fun |output_gate_n _witness_.anyinit_procdff_362| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#0| state))
(declare-fun |output_gate#1| (|output_gate_s|) (_ BitVec 1)) ; \_witness_.anyinit_procdff_365
(define-fun |output_gate_n _witness_.anyinit_procdff_365| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#1| state)) #b1))
(declare-fun |output_gate#2| (|output_gate_s|) (_ BitVec 1)) ; \_witness_.anyinit_procdff_368
(define-fun |output_gate_n _witness_.anyinit_procdff_368| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#2| state)) #b1))
(declare-fun |output_gate#3| (|output_gate_s|) (_ BitVec 1)) ; \_witness_.anyinit_procdff_371
(define-fun |output_gate_n _witness_.anyinit_procdff_371| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#3| state)) #b1))
(declare-fun |output_gate#4| (|output_gate_s|) (_ BitVec 11)) ; \alive_left_q
(define-fun |output_gate_n alive_left_q| ((state |output_gate_s|)) (_ BitVec 11) (|output_gate#4| state))
(declare-fun |output_gate#5| (|output_gate_s|) (_ BitVec 1)) ; \silent_q
(define-fun |output_gate#6| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#5| state)) #b1) false))) ; \alive_o
(define-fun |output_gate_n alive_o| ((state |output_gate_s|)) Bool (|output_gate#6| state))
(declare-fun |output_gate#7| (|output_gate_s|) (_ BitVec 1)) ; \clock_lost_i
(define-fun |output_gate#8| ((state |output_gate_s|)) (_ BitVec 32) (ite (= ((_ extract 0 0) (|output_gate#7| state)) #b1) #b00000000000000000000000000000000 (|output_gate#0| state))) ; \channel_q
(define-fun |output_gate#9| ((state |output_gate_s|)) Bool (distinct (|output_gate#8| state) #b00000000000000000000000000000000)) ; $ne$output_gate_properties.vh:83$174_Y
(define-fun |output_gate#10| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#7| state)) #b1) #b0 (|output_gate#1| state))) ; \hv_enable_q
(define-fun |output_gate#11| ((state |output_gate_s|)) Bool (or  (|output_gate#9| state) false  (= ((_ extract 0 0) (|output_gate#10| state)) #b1) false)) ; $logic_or$output_gate_properties.vh:83$175_Y
(define-fun |output_gate#12| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#7| state)) #b1) #b0 (|output_gate#3| state))) ; \hv_alive_q
(define-fun |output_gate#13| ((state |output_gate_s|)) Bool (or  (|output_gate#11| state) false  (= ((_ extract 0 0) (|output_gate#12| state)) #b1) false)) ; $logic_or$output_gate_properties.vh:83$176_Y
(define-fun |output_gate#14| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#7| state)) #b1) #b0 (|output_gate#2| state))) ; \focus_q
(define-fun |output_gate#15| ((state |output_gate_s|)) Bool (or  (|output_gate#13| state) false  (= ((_ extract 0 0) (|output_gate#14| state)) #b1) false)) ; \any
(define-fun |output_gate_n any| ((state |output_gate_s|)) Bool (|output_gate#15| state))
(declare-fun |output_gate#16| (|output_gate_s|) Bool) ; \arm_i
(define-fun |output_gate_n arm_i| ((state |output_gate_s|)) Bool (|output_gate#16| state))
(define-fun |output_gate#17| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#16| state) #b1 #b0)) ; \arm_is_allowed_EN
(define-fun |output_gate_n arm_is_allowed_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#17| state)) #b1))
(declare-fun |output_gate#18| (|output_gate_s|) (_ BitVec 3)) ; \state_q
(define-fun |output_gate#19| ((state |output_gate_s|)) Bool (= (|output_gate#18| state) #b010)) ; \armed_o
(define-fun |output_gate_n armed_o| ((state |output_gate_s|)) Bool (|output_gate#19| state))
(declare-fun |output_gate#20| (|output_gate_s|) (_ BitVec 5)) ; \limits_1_q
(define-fun |output_gate#21| ((state |output_gate_s|)) Bool (distinct (|output_gate#20| state) #b00000)) ; $ne$output_gate_properties.vh:91$191_Y
(define-fun |output_gate#22| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#21| state) #b1 #b0)) ; $procmux$323_Y
(declare-fun |output_gate#23| (|output_gate_s|) (_ BitVec 1)) ; \started_q
(define-fun |output_gate#24| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#23| state)) #b1) (|output_gate#22| state) #b0)) ; \beyond_is_off_EN
(define-fun |output_gate_n beyond_is_off_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#24| state)) #b1))
(declare-fun |output_gate#25| (|output_gate_s|) (_ BitVec 16)) ; \bit_ticks_i
(define-fun |output_gate_n bit_ticks_i| ((state |output_gate_s|)) (_ BitVec 16) (|output_gate#25| state))
(declare-fun |output_gate#26| (|output_gate_s|) Bool) ; \run_permit_i
(define-fun |output_gate#27| ((state |output_gate_s|)) Bool (not (or  (|output_gate#26| state) false))) ; \wrong [0]
(declare-fun |output_gate#28| (|output_gate_s|) Bool) ; \temperature_good_i
(define-fun |output_gate#29| ((state |output_gate_s|)) Bool (not (or  (|output_gate#28| state) false))) ; \wrong [2]
(declare-fun |output_gate#30| (|output_gate_s|) (_ BitVec 6)) ; { \limits_i \underrun_i }
(declare-fun |output_gate#31| (|output_gate_s|) (_ BitVec 1)) ; \live_q
(define-fun |output_gate#32| ((state |output_gate_s|)) (_ BitVec 9) (bvand (concat (|output_gate#30| state) (concat (ite (|output_gate#29| state) #b1 #b0) (concat (|output_gate#5| state) (ite (|output_gate#27| state) #b1 #b0)))) (concat (|output_gate#31| state) (concat (|output_gate#31| state) (concat #b11 (concat (|output_gate#31| state) (concat (|output_gate#31| state) (concat (|output_gate#31| state) (concat (|output_gate#31| state) (|output_gate#31| state)))))))))) ; \cause
(define-fun |output_gate_n cause| ((state |output_gate_s|)) (_ BitVec 9) (|output_gate#32| state))
(declare-fun |output_gate#33| (|output_gate_s|) (_ BitVec 32)) ; \channel_mask_i
(define-fun |output_gate_n channel_mask_i| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#33| state))
(define-fun |output_gate_n channel_o| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#8| state))
(define-fun |output_gate_n channel_q| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#8| state))
(declare-fun |output_gate#34| (|output_gate_s|) Bool) ; \clear_i
(define-fun |output_gate_n clear_i| ((state |output_gate_s|)) Bool (|output_gate#34| state))
(declare-fun |output_gate#35| (|output_gate_s|) Bool) ; \clk_i
(define-fun |output_gate_n clk_i| ((state |output_gate_s|)) Bool (|output_gate#35| state))
(define-fun |output_gate_n clock_is_lost_in_reset_EN| ((state |output_gate_s|)) Bool true)
(define-fun |output_gate_n clock_lost_i| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#7| state)) #b1))
(declare-fun |output_gate#36| (|output_gate_s|) (_ BitVec 1)) ; \cool_1_q
(define-fun |output_gate_n cool_1_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#36| state)) #b1))
(declare-fun |output_gate#37| (|output_gate_s|) Bool) ; \disarm_i
(define-fun |output_gate_n disarm_i| ((state |output_gate_s|)) Bool (|output_gate#37| state))
(declare-fun |output_gate#38| (|output_gate_s|) (_ BitVec 32)) ; \drive_1_q
(define-fun |output_gate_n drive_1_q| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#38| state))
(declare-fun |output_gate#39| (|output_gate_s|) (_ BitVec 32)) ; \drive_i
(define-fun |output_gate_n drive_i| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#39| state))
(define-fun |output_gate_n edges| ((state |output_gate_s|)) (_ BitVec 3) (concat ((_ extract 3 2) (|output_gate#30| state)) #b0))
(declare-fun |output_gate#40| (|output_gate_s|) (_ BitVec 32)) ; \emissions_q
(define-fun |output_gate_n emissions_o| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#40| state))
(define-fun |output_gate_n emissions_q| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#40| state))
(declare-fun |output_gate#41| (|output_gate_s|) Bool) ; \ended_i
(define-fun |output_gate_n ended_i| ((state |output_gate_s|)) Bool (|output_gate#41| state))
(define-fun |output_gate#42| ((state |output_gate_s|)) Bool (= (|output_gate#18| state) #b101)) ; \settling
(define-fun |output_gate#43| ((state |output_gate_s|)) Bool (= (|output_gate#18| state) #b001)) ; \ramp_up_o
(define-fun |output_gate#44| ((state |output_gate_s|)) Bool (or  (|output_gate#43| state) false  (|output_gate#19| state) false)) ; $logic_or$output_gate.v:84$6_Y
(define-fun |output_gate#45| ((state |output_gate_s|)) Bool (= (|output_gate#18| state) #b011)) ; \stopping_o
(define-fun |output_gate#46| ((state |output_gate_s|)) Bool (or  (|output_gate#44| state) false  (|output_gate#45| state) false)) ; $logic_or$output_gate.v:84$8_Y
(define-fun |output_gate#47| ((state |output_gate_s|)) Bool (= (|output_gate#18| state) #b100)) ; \ramp_down_o
(define-fun |output_gate#48| ((state |output_gate_s|)) Bool (or  (|output_gate#46| state) false  (|output_gate#47| state) false)) ; \moves
(define-fun |output_gate#49| ((state |output_gate_s|)) Bool (or  (|output_gate#42| state) false  (|output_gate#48| state) false)) ; \on
(define-fun |output_gate#50| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#18| state)) #b1) (= ((_ extract 1 1) (|output_gate#18| state)) #b1) (= ((_ extract 2 2) (|output_gate#18| state)) #b1)))) ; \off_o
(define-fun |output_gate#51| ((state |output_gate_s|)) Bool (or  (|output_gate#49| state) false  (|output_gate#50| state) false)) ; \exists
(define-fun |output_gate_n exists| ((state |output_gate_s|)) Bool (|output_gate#51| state))
(declare-fun |output_gate#52| (|output_gate_s|) (_ BitVec 1)) ; \exists_1_q
(define-fun |output_gate_n exists_1_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#52| state)) #b1))
(declare-fun |output_gate#53| (|output_gate_s|) (_ BitVec 32)) ; \fault_count_q
(define-fun |output_gate_n fault_count_o| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#53| state))
(define-fun |output_gate_n fault_count_q| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#53| state))
(declare-fun |output_gate#54| (|output_gate_s|) (_ BitVec 9)) ; \fault_q
(define-fun |output_gate_n fault_o| ((state |output_gate_s|)) (_ BitVec 16) (concat #b0000000 (|output_gate#54| state)))
(define-fun |output_gate_n fault_q| ((state |output_gate_s|)) (_ BitVec 9) (|output_gate#54| state))
(declare-fun |output_gate#55| (|output_gate_s|) (_ BitVec 64)) ; \fault_time_q
(define-fun |output_gate_n fault_time_o| ((state |output_gate_s|)) (_ BitVec 64) (|output_gate#55| state))
(define-fun |output_gate_n fault_time_q| ((state |output_gate_s|)) (_ BitVec 64) (|output_gate#55| state))
(declare-fun |output_gate#56| (|output_gate_s|) (_ BitVec 1)) ; \faulted_q
(define-fun |output_gate_n faulted_o| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#56| state)) #b1))
(define-fun |output_gate_n faulted_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#56| state)) #b1))
(declare-fun |output_gate#57| (|output_gate_s|) (_ BitVec 16)) ; \focus_left_q
(define-fun |output_gate_n focus_left_q| ((state |output_gate_s|)) (_ BitVec 16) (|output_gate#57| state))
(define-fun |output_gate_n focus_o| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#14| state)) #b1))
(define-fun |output_gate_n focus_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#14| state)) #b1))
(declare-fun |output_gate#58| (|output_gate_s|) Bool) ; \heartbeat_i
(define-fun |output_gate_n heartbeat_i| ((state |output_gate_s|)) Bool (|output_gate#58| state))
(declare-fun |output_gate#59| (|output_gate_s|) (_ BitVec 32)) ; \heartbeat_ticks_i
(define-fun |output_gate_n heartbeat_ticks_i| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#59| state))
(define-fun |output_gate#60| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#36| state)) #b1) #b0 #b1)) ; $procmux$331_Y
(define-fun |output_gate#61| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#23| state)) #b1) (|output_gate#60| state) #b0)) ; \hot_is_off_EN
(define-fun |output_gate_n hot_is_off_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#61| state)) #b1))
(define-fun |output_gate_n hv_alive_o| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#12| state)) #b1))
(define-fun |output_gate_n hv_alive_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#12| state)) #b1))
(define-fun |output_gate_n hv_enable_o| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#10| state)) #b1))
(define-fun |output_gate_n hv_enable_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#10| state)) #b1))
(define-fun |output_gate_n limits_1_q| ((state |output_gate_s|)) (_ BitVec 5) (|output_gate#20| state))
(define-fun |output_gate_n limits_i| ((state |output_gate_s|)) (_ BitVec 5) ((_ extract 5 1) (|output_gate#30| state)))
(define-fun |output_gate_n live_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#31| state)) #b1))
(declare-fun |output_gate#62| (|output_gate_s|) (_ BitVec 32)) ; \mask_1_q
(define-fun |output_gate_n mask_1_q| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#62| state))
(define-fun |output_gate#63| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#23| state)) #b1) #b1 #b0)) ; \mask_is_kept_EN
(define-fun |output_gate_n mask_is_kept_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#63| state)) #b1))
(define-fun |output_gate_n moves| ((state |output_gate_s|)) Bool (|output_gate#48| state))
(declare-fun |output_gate#64| (|output_gate_s|) (_ BitVec 3)) ; \moves_later_q
(define-fun |output_gate_n moves_later_q| ((state |output_gate_s|)) (_ BitVec 3) (|output_gate#64| state))
(define-fun |output_gate#65| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#7| state)) #b1) #b1 #b0)) ; \no_clock_is_off_EN
(define-fun |output_gate_n no_clock_is_off_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#65| state)) #b1))
(define-fun |output_gate#66| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#52| state)) #b1) #b0 #b1)) ; $procmux$315_Y
(define-fun |output_gate#67| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#23| state)) #b1) (|output_gate#66| state) #b0)) ; \nonsense_is_off_EN
(define-fun |output_gate_n nonsense_is_off_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#67| state)) #b1))
(declare-fun |output_gate#68| (|output_gate_s|) (_ BitVec 64)) ; \now_i
(define-fun |output_gate_n now_i| ((state |output_gate_s|)) (_ BitVec 64) (|output_gate#68| state))
(define-fun |output_gate_n off_o| ((state |output_gate_s|)) Bool (|output_gate#50| state))
(define-fun |output_gate_n on| ((state |output_gate_s|)) Bool (|output_gate#49| state))
(declare-fun |output_gate#69| (|output_gate_s|) (_ BitVec 3)) ; \on_later_q
(define-fun |output_gate_n on_later_q| ((state |output_gate_s|)) (_ BitVec 3) (|output_gate#69| state))
(define-fun |output_gate_n only_what_is_played_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#63| state)) #b1))
(define-fun |output_gate#70| ((state |output_gate_s|)) Bool (not (or  (|output_gate#27| state) (= ((_ extract 0 0) (|output_gate#5| state)) #b1) (|output_gate#29| state) (= ((_ extract 0 0) (|output_gate#30| state)) #b1) (= ((_ extract 1 1) (|output_gate#30| state)) #b1) (= ((_ extract 2 2) (|output_gate#30| state)) #b1) (= ((_ extract 3 3) (|output_gate#30| state)) #b1) (= ((_ extract 4 4) (|output_gate#30| state)) #b1) (= ((_ extract 5 5) (|output_gate#30| state)) #b1)))) ; $eq$output_gate.v:95$19_Y
(define-fun |output_gate#71| ((state |output_gate_s|)) Bool (and (or  (|output_gate#51| state) false) (or  (|output_gate#70| state) false))) ; \stays
(define-fun |output_gate#72| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 2 2) (|output_gate#69| state)) #b1) false) (or  (|output_gate#71| state) false))) ; \open
(define-fun |output_gate_n open| ((state |output_gate_s|)) Bool (|output_gate#72| state))
(declare-fun |output_gate#73| (|output_gate_s|) (_ BitVec 1)) ; \permit_1_q
(define-fun |output_gate_n permit_1_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#73| state)) #b1))
(declare-fun |output_gate#74| (|output_gate_s|) Bool) ; \ramp_done_i
(define-fun |output_gate_n ramp_done_i| ((state |output_gate_s|)) Bool (|output_gate#74| state))
(define-fun |output_gate_n ramp_down_o| ((state |output_gate_s|)) Bool (|output_gate#47| state))
(define-fun |output_gate_n ramp_up_o| ((state |output_gate_s|)) Bool (|output_gate#43| state))
(declare-fun |output_gate#75| (|output_gate_s|) (_ BitVec 1)) ; \rst_1_q
(define-fun |output_gate#76| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#75| state)) #b1) #b1 #b0)) ; $procmux$339_Y
(define-fun |output_gate#77| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#23| state)) #b1) (|output_gate#76| state) #b0)) ; \reset_is_off_EN
(define-fun |output_gate_n reset_is_off_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#77| state)) #b1))
(declare-fun |output_gate#78| (|output_gate_s|) (_ BitVec 32)) ; \rest_left_q
(define-fun |output_gate_n rest_left_q| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#78| state))
(declare-fun |output_gate#79| (|output_gate_s|) (_ BitVec 1)) ; \resting_q
(define-fun |output_gate_n resting_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#79| state)) #b1))
(define-fun |output_gate#80| ((state |output_gate_s|)) (_ BitVec 9) (bvand (concat ((_ extract 8 4) (|output_gate#54| state)) #b0000) (concat (|output_gate#79| state) (concat (|output_gate#79| state) (concat (|output_gate#79| state) (concat (|output_gate#79| state) (concat (|output_gate#79| state) (concat (|output_gate#79| state) (concat (|output_gate#79| state) (concat (|output_gate#79| state) (|output_gate#79| state))))))))))) ; \rests
(define-fun |output_gate_n rests| ((state |output_gate_s|)) (_ BitVec 9) (|output_gate#80| state))
(define-fun |output_gate_n rst_1_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#75| state)) #b1))
(declare-fun |output_gate#81| (|output_gate_s|) Bool) ; \rst_i
(define-fun |output_gate_n rst_i| ((state |output_gate_s|)) Bool (|output_gate#81| state))
(define-fun |output_gate_n run_permit_i| ((state |output_gate_s|)) Bool (|output_gate#26| state))
(declare-fun |output_gate#82| (|output_gate_s|) (_ BitVec 16)) ; \settle_left_q
(define-fun |output_gate_n settle_left_q| ((state |output_gate_s|)) (_ BitVec 16) (|output_gate#82| state))
(declare-fun |output_gate#83| (|output_gate_s|) Bool) ; \settled_i
(define-fun |output_gate_n settled_i| ((state |output_gate_s|)) Bool (|output_gate#83| state))
(define-fun |output_gate_n settling| ((state |output_gate_s|)) Bool (|output_gate#42| state))
(define-fun |output_gate_n settling_o| ((state |output_gate_s|)) Bool (|output_gate#42| state))
(define-fun |output_gate#84| ((state |output_gate_s|)) Bool (distinct (|output_gate#32| state) #b000000000)) ; \shut
(define-fun |output_gate_n shut| ((state |output_gate_s|)) Bool (|output_gate#84| state))
(define-fun |output_gate_n shut_o| ((state |output_gate_s|)) Bool (|output_gate#84| state))
(declare-fun |output_gate#85| (|output_gate_s|) (_ BitVec 32)) ; \silence_q
(define-fun |output_gate_n silence_q| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#85| state))
(declare-fun |output_gate#86| (|output_gate_s|) (_ BitVec 1)) ; \silent_1_q
(define-fun |output_gate_n silent_1_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#86| state)) #b1))
(define-fun |output_gate#87| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#86| state)) #b1) #b1 #b0)) ; $procmux$327_Y
(define-fun |output_gate#88| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#23| state)) #b1) (|output_gate#87| state) #b0)) ; \silent_is_off_EN
(define-fun |output_gate_n silent_is_off_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#88| state)) #b1))
(define-fun |output_gate_n silent_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#5| state)) #b1))
(define-fun |output_gate_n started_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#23| state)) #b1))
(define-fun |output_gate_n state_q| ((state |output_gate_s|)) (_ BitVec 3) (|output_gate#18| state))
(define-fun |output_gate_n stays| ((state |output_gate_s|)) Bool (|output_gate#71| state))
(define-fun |output_gate#89| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#73| state)) #b1) #b0 #b1)) ; $procmux$335_Y
(define-fun |output_gate#90| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#23| state)) #b1) (|output_gate#89| state) #b0)) ; \stopped_is_off_EN
(define-fun |output_gate_n stopped_is_off_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#90| state)) #b1))
(define-fun |output_gate_n stopping_o| ((state |output_gate_s|)) Bool (|output_gate#45| state))
(define-fun |output_gate_n temperature_good_i| ((state |output_gate_s|)) Bool (|output_gate#28| state))
(declare-fun |output_gate#91| (|output_gate_s|) (_ BitVec 1)) ; \underrun_1_q
(define-fun |output_gate_n underrun_1_q| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#91| state)) #b1))
(define-fun |output_gate_n underrun_i| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#30| state)) #b1))
(define-fun |output_gate#92| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#91| state)) #b1) #b1 #b0)) ; $procmux$319_Y
(define-fun |output_gate#93| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#23| state)) #b1) (|output_gate#92| state) #b0)) ; \underrun_is_off_EN
(define-fun |output_gate_n underrun_is_off_EN| ((state |output_gate_s|)) Bool (= ((_ extract 0 0) (|output_gate#93| state)) #b1))
(declare-fun |output_gate#94| (|output_gate_s|) (_ BitVec 32)) ; \underruns_q
(define-fun |output_gate_n underruns_o| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#94| state))
(define-fun |output_gate_n underruns_q| ((state |output_gate_s|)) (_ BitVec 32) (|output_gate#94| state))
(define-fun |output_gate_n wrong| ((state |output_gate_s|)) (_ BitVec 9) (concat (|output_gate#30| state) (concat (ite (|output_gate#29| state) #b1 #b0) (concat (|output_gate#5| state) (ite (|output_gate#27| state) #b1 #b0)))))
(define-fun |output_gate#95| ((state |output_gate_s|)) (_ BitVec 1) (bvnot (ite (|output_gate#35| state) #b1 #b0))) ; $auto$rtlil.cc:3245:Not$489
(define-fun |output_gate_u 0| ((state |output_gate_s|)) Bool (or (= ((_ extract 0 0) (|output_gate#95| state)) #b1) (not true))) ; $auto$formalff.cc:987:execute$490
(define-fun |output_gate#96| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#54| state)) #b1) (= ((_ extract 1 1) (|output_gate#54| state)) #b1) (= ((_ extract 2 2) (|output_gate#54| state)) #b1) (= ((_ extract 3 3) (|output_gate#54| state)) #b1) (= ((_ extract 4 4) (|output_gate#54| state)) #b1) (= ((_ extract 5 5) (|output_gate#54| state)) #b1) (= ((_ extract 6 6) (|output_gate#54| state)) #b1) (= ((_ extract 7 7) (|output_gate#54| state)) #b1) (= ((_ extract 8 8) (|output_gate#54| state)) #b1) false false false false false false false))) ; $eq$output_gate_properties.vh:36$87_Y
(define-fun |output_gate#97| ((state |output_gate_s|)) Bool (and (or  (|output_gate#50| state) false) (or  (|output_gate#96| state) false))) ; $logic_and$output_gate_properties.vh:36$88_Y
(define-fun |output_gate#98| ((state |output_gate_s|)) Bool (and (or  (|output_gate#97| state) false) (or  (|output_gate#26| state) false))) ; $logic_and$output_gate_properties.vh:36$89_Y
(define-fun |output_gate#99| ((state |output_gate_s|)) Bool (and (or  (|output_gate#98| state) false) (or  (|output_gate#28| state) false))) ; $logic_and$output_gate_properties.vh:36$90_Y
(define-fun |output_gate#100| ((state |output_gate_s|)) Bool (and (or  (|output_gate#99| state) false) (or  (|output_gate#58| state) false))) ; $logic_and$output_gate_properties.vh:36$91_Y
(define-fun |output_gate_u 1| ((state |output_gate_s|)) Bool (or (|output_gate#100| state) (not (= ((_ extract 0 0) (|output_gate#17| state)) #b1)))) ; arm_is_allowed
(define-fun |output_gate#101| ((state |output_gate_s|)) Bool (not (or  (|output_gate#15| state) false))) ; $logic_not$output_gate_properties.vh:87$179_Y
(define-fun |output_gate_a 0| ((state |output_gate_s|)) Bool (or (|output_gate#101| state) (not (= ((_ extract 0 0) (|output_gate#24| state)) #b1)))) ; beyond_is_off
(define-fun |output_gate#102| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#7| state)) #b1) false))) ; $logic_not$output_gate_properties.vh:38$92_Y
(define-fun |output_gate#103| ((state |output_gate_s|)) Bool (or  (|output_gate#102| state) false  (|output_gate#81| state) false)) ; $logic_or$output_gate_properties.vh:38$93_Y
(define-fun |output_gate_u 2| ((state |output_gate_s|)) Bool (or (|output_gate#103| state) (not true))) ; clock_is_lost_in_reset
(define-fun |output_gate_a 1| ((state |output_gate_s|)) Bool (or (|output_gate#101| state) (not (= ((_ extract 0 0) (|output_gate#61| state)) #b1)))) ; hot_is_off
(define-fun |output_gate#104| ((state |output_gate_s|)) (_ BitVec 32) (bvnot (|output_gate#62| state))) ; $not$output_gate_properties.vh:95$196_Y
(define-fun |output_gate#105| ((state |output_gate_s|)) (_ BitVec 32) (bvand (|output_gate#8| state) (|output_gate#104| state))) ; $and$output_gate_properties.vh:95$197_Y
(define-fun |output_gate#106| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#105| state)) #b1) (= ((_ extract 1 1) (|output_gate#105| state)) #b1) (= ((_ extract 2 2) (|output_gate#105| state)) #b1) (= ((_ extract 3 3) (|output_gate#105| state)) #b1) (= ((_ extract 4 4) (|output_gate#105| state)) #b1) (= ((_ extract 5 5) (|output_gate#105| state)) #b1) (= ((_ extract 6 6) (|output_gate#105| state)) #b1) (= ((_ extract 7 7) (|output_gate#105| state)) #b1) (= ((_ extract 8 8) (|output_gate#105| state)) #b1) (= ((_ extract 9 9) (|output_gate#105| state)) #b1) (= ((_ extract 10 10) (|output_gate#105| state)) #b1) (= ((_ extract 11 11) (|output_gate#105| state)) #b1) (= ((_ extract 12 12) (|output_gate#105| state)) #b1) (= ((_ extract 13 13) (|output_gate#105| state)) #b1) (= ((_ extract 14 14) (|output_gate#105| state)) #b1) (= ((_ extract 15 15) (|output_gate#105| state)) #b1) (= ((_ extract 16 16) (|output_gate#105| state)) #b1) (= ((_ extract 17 17) (|output_gate#105| state)) #b1) (= ((_ extract 18 18) (|output_gate#105| state)) #b1) (= ((_ extract 19 19) (|output_gate#105| state)) #b1) (= ((_ extract 20 20) (|output_gate#105| state)) #b1) (= ((_ extract 21 21) (|output_gate#105| state)) #b1) (= ((_ extract 22 22) (|output_gate#105| state)) #b1) (= ((_ extract 23 23) (|output_gate#105| state)) #b1) (= ((_ extract 24 24) (|output_gate#105| state)) #b1) (= ((_ extract 25 25) (|output_gate#105| state)) #b1) (= ((_ extract 26 26) (|output_gate#105| state)) #b1) (= ((_ extract 27 27) (|output_gate#105| state)) #b1) (= ((_ extract 28 28) (|output_gate#105| state)) #b1) (= ((_ extract 29 29) (|output_gate#105| state)) #b1) (= ((_ extract 30 30) (|output_gate#105| state)) #b1) (= ((_ extract 31 31) (|output_gate#105| state)) #b1)))) ; $eq$output_gate_properties.vh:95$198_Y
(define-fun |output_gate_a 2| ((state |output_gate_s|)) Bool (or (|output_gate#106| state) (not (= ((_ extract 0 0) (|output_gate#63| state)) #b1)))) ; mask_is_kept
(define-fun |output_gate#107| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#8| state)) #b1) (= ((_ extract 1 1) (|output_gate#8| state)) #b1) (= ((_ extract 2 2) (|output_gate#8| state)) #b1) (= ((_ extract 3 3) (|output_gate#8| state)) #b1) (= ((_ extract 4 4) (|output_gate#8| state)) #b1) (= ((_ extract 5 5) (|output_gate#8| state)) #b1) (= ((_ extract 6 6) (|output_gate#8| state)) #b1) (= ((_ extract 7 7) (|output_gate#8| state)) #b1) (= ((_ extract 8 8) (|output_gate#8| state)) #b1) (= ((_ extract 9 9) (|output_gate#8| state)) #b1) (= ((_ extract 10 10) (|output_gate#8| state)) #b1) (= ((_ extract 11 11) (|output_gate#8| state)) #b1) (= ((_ extract 12 12) (|output_gate#8| state)) #b1) (= ((_ extract 13 13) (|output_gate#8| state)) #b1) (= ((_ extract 14 14) (|output_gate#8| state)) #b1) (= ((_ extract 15 15) (|output_gate#8| state)) #b1) (= ((_ extract 16 16) (|output_gate#8| state)) #b1) (= ((_ extract 17 17) (|output_gate#8| state)) #b1) (= ((_ extract 18 18) (|output_gate#8| state)) #b1) (= ((_ extract 19 19) (|output_gate#8| state)) #b1) (= ((_ extract 20 20) (|output_gate#8| state)) #b1) (= ((_ extract 21 21) (|output_gate#8| state)) #b1) (= ((_ extract 22 22) (|output_gate#8| state)) #b1) (= ((_ extract 23 23) (|output_gate#8| state)) #b1) (= ((_ extract 24 24) (|output_gate#8| state)) #b1) (= ((_ extract 25 25) (|output_gate#8| state)) #b1) (= ((_ extract 26 26) (|output_gate#8| state)) #b1) (= ((_ extract 27 27) (|output_gate#8| state)) #b1) (= ((_ extract 28 28) (|output_gate#8| state)) #b1) (= ((_ extract 29 29) (|output_gate#8| state)) #b1) (= ((_ extract 30 30) (|output_gate#8| state)) #b1) (= ((_ extract 31 31) (|output_gate#8| state)) #b1)))) ; $eq$output_gate_properties.vh:45$95_Y
(define-fun |output_gate#108| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#10| state)) #b1) false))) ; $logic_not$output_gate_properties.vh:45$96_Y
(define-fun |output_gate#109| ((state |output_gate_s|)) Bool (and (or  (|output_gate#107| state) false) (or  (|output_gate#108| state) false))) ; $logic_and$output_gate_properties.vh:45$97_Y
(define-fun |output_gate#110| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#12| state)) #b1) false))) ; $logic_not$output_gate_properties.vh:45$98_Y
(define-fun |output_gate#111| ((state |output_gate_s|)) Bool (and (or  (|output_gate#109| state) false) (or  (|output_gate#110| state) false))) ; $logic_and$output_gate_properties.vh:45$99_Y
(define-fun |output_gate#112| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#14| state)) #b1) false))) ; $logic_not$output_gate_properties.vh:45$100_Y
(define-fun |output_gate#113| ((state |output_gate_s|)) Bool (and (or  (|output_gate#111| state) false) (or  (|output_gate#112| state) false))) ; $logic_and$output_gate_properties.vh:45$101_Y
(define-fun |output_gate_a 3| ((state |output_gate_s|)) Bool (or (|output_gate#113| state) (not (= ((_ extract 0 0) (|output_gate#65| state)) #b1)))) ; no_clock_is_off
(define-fun |output_gate_a 4| ((state |output_gate_s|)) Bool (or (|output_gate#101| state) (not (= ((_ extract 0 0) (|output_gate#67| state)) #b1)))) ; nonsense_is_off
(define-fun |output_gate#114| ((state |output_gate_s|)) (_ BitVec 32) (bvnot (|output_gate#38| state))) ; $not$output_gate_properties.vh:96$199_Y
(define-fun |output_gate#115| ((state |output_gate_s|)) (_ BitVec 32) (bvand (|output_gate#8| state) (|output_gate#114| state))) ; $and$output_gate_properties.vh:96$200_Y
(define-fun |output_gate#116| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#115| state)) #b1) (= ((_ extract 1 1) (|output_gate#115| state)) #b1) (= ((_ extract 2 2) (|output_gate#115| state)) #b1) (= ((_ extract 3 3) (|output_gate#115| state)) #b1) (= ((_ extract 4 4) (|output_gate#115| state)) #b1) (= ((_ extract 5 5) (|output_gate#115| state)) #b1) (= ((_ extract 6 6) (|output_gate#115| state)) #b1) (= ((_ extract 7 7) (|output_gate#115| state)) #b1) (= ((_ extract 8 8) (|output_gate#115| state)) #b1) (= ((_ extract 9 9) (|output_gate#115| state)) #b1) (= ((_ extract 10 10) (|output_gate#115| state)) #b1) (= ((_ extract 11 11) (|output_gate#115| state)) #b1) (= ((_ extract 12 12) (|output_gate#115| state)) #b1) (= ((_ extract 13 13) (|output_gate#115| state)) #b1) (= ((_ extract 14 14) (|output_gate#115| state)) #b1) (= ((_ extract 15 15) (|output_gate#115| state)) #b1) (= ((_ extract 16 16) (|output_gate#115| state)) #b1) (= ((_ extract 17 17) (|output_gate#115| state)) #b1) (= ((_ extract 18 18) (|output_gate#115| state)) #b1) (= ((_ extract 19 19) (|output_gate#115| state)) #b1) (= ((_ extract 20 20) (|output_gate#115| state)) #b1) (= ((_ extract 21 21) (|output_gate#115| state)) #b1) (= ((_ extract 22 22) (|output_gate#115| state)) #b1) (= ((_ extract 23 23) (|output_gate#115| state)) #b1) (= ((_ extract 24 24) (|output_gate#115| state)) #b1) (= ((_ extract 25 25) (|output_gate#115| state)) #b1) (= ((_ extract 26 26) (|output_gate#115| state)) #b1) (= ((_ extract 27 27) (|output_gate#115| state)) #b1) (= ((_ extract 28 28) (|output_gate#115| state)) #b1) (= ((_ extract 29 29) (|output_gate#115| state)) #b1) (= ((_ extract 30 30) (|output_gate#115| state)) #b1) (= ((_ extract 31 31) (|output_gate#115| state)) #b1)))) ; $eq$output_gate_properties.vh:96$201_Y
(define-fun |output_gate_a 5| ((state |output_gate_s|)) Bool (or (|output_gate#116| state) (not (= ((_ extract 0 0) (|output_gate#63| state)) #b1)))) ; only_what_is_played
(define-fun |output_gate#117| ((state |output_gate_s|)) Bool (and (or  (|output_gate#101| state) false) (or  (|output_gate#50| state) false))) ; $logic_and$output_gate_properties.vh:87$181_Y
(define-fun |output_gate#118| ((state |output_gate_s|)) Bool (and (or  (|output_gate#117| state) false) (or  (|output_gate#96| state) false))) ; $logic_and$output_gate_properties.vh:87$183_Y
(define-fun |output_gate#119| ((state |output_gate_s|)) Bool (and (or  (|output_gate#118| state) false) (or  (= ((_ extract 0 0) (|output_gate#5| state)) #b1) false))) ; $logic_and$output_gate_properties.vh:87$185_Y
(define-fun |output_gate_a 6| ((state |output_gate_s|)) Bool (or (|output_gate#119| state) (not (= ((_ extract 0 0) (|output_gate#77| state)) #b1)))) ; reset_is_off
(define-fun |output_gate_a 7| ((state |output_gate_s|)) Bool (or (|output_gate#101| state) (not (= ((_ extract 0 0) (|output_gate#88| state)) #b1)))) ; silent_is_off
(define-fun |output_gate_a 8| ((state |output_gate_s|)) Bool (or (|output_gate#101| state) (not (= ((_ extract 0 0) (|output_gate#90| state)) #b1)))) ; stopped_is_off
(define-fun |output_gate_a 9| ((state |output_gate_s|)) Bool (or (|output_gate#101| state) (not (= ((_ extract 0 0) (|output_gate#93| state)) #b1)))) ; underrun_is_off
(define-fun |output_gate#120| ((state |output_gate_s|)) (_ BitVec 32) (bvadd (|output_gate#94| state) #b00000000000000000000000000000001)) ; $add$output_gate.v:122$40_Y
(define-fun |output_gate#121| ((state |output_gate_s|)) Bool (and (or  (= ((_ extract 0 0) (|output_gate#31| state)) #b1) false) (or  (= ((_ extract 0 0) (|output_gate#30| state)) #b1) false))) ; $logic_and$output_gate.v:122$39_Y
(define-fun |output_gate#122| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#121| state) (|output_gate#120| state) (|output_gate#94| state))) ; $procmux$241_Y
(define-fun |output_gate#123| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#81| state) #b00000000000000000000000000000000 (|output_gate#122| state))) ; $0\underruns_q[31:0]
(define-fun |output_gate#124| ((state |output_gate_s|)) (_ BitVec 32) (bvsub (|output_gate#85| state) #b00000000000000000000000000000001)) ; $sub$output_gate.v:105$26_Y
(define-fun |output_gate#125| ((state |output_gate_s|)) (_ BitVec 32) (ite (= ((_ extract 0 0) (|output_gate#5| state)) #b1) (|output_gate#85| state) (|output_gate#124| state))) ; $procmux$270_Y
(define-fun |output_gate#126| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#58| state) (|output_gate#59| state) (|output_gate#125| state))) ; $procmux$273_Y
(define-fun |output_gate#127| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#81| state) #b00000000000000000000000000000000 (|output_gate#126| state))) ; $0\silence_q[31:0]
(define-fun |output_gate#128| ((state |output_gate_s|)) (_ BitVec 16) (bvsub (|output_gate#82| state) #b0000000000000001)) ; $sub$output_gate.v:135$42_Y
(define-fun |output_gate#129| ((state |output_gate_s|)) (_ BitVec 16) (ite (|output_gate#42| state) (|output_gate#128| state) #b1111010000100011)) ; $ternary$output_gate.v:135$43_Y
(define-fun |output_gate#130| ((state |output_gate_s|)) (_ BitVec 16) (ite (|output_gate#81| state) #b0000000000000000 (|output_gate#129| state))) ; $0\settle_left_q[15:0]
(define-fun |output_gate#131| ((state |output_gate_s|)) Bool (distinct (|output_gate#78| state) #b00000000000000000000000000000001)) ; $ne$output_gate.v:116$35_Y
(define-fun |output_gate#132| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#79| state)) #b1) (ite (|output_gate#131| state) #b1 #b0) #b0)) ; $procmux$249_Y
(define-fun |output_gate#133| ((state |output_gate_s|)) Bool (distinct ((_ extract 8 4) (|output_gate#32| state)) #b00000)) ; $ne$output_gate.v:111$33_Y
(define-fun |output_gate#134| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#133| state) #b1 (|output_gate#132| state))) ; $procmux$252_Y
(define-fun |output_gate#135| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#81| state) #b0 (|output_gate#134| state))) ; $0\resting_q[0:0]
(define-fun |output_gate#136| ((state |output_gate_s|)) (_ BitVec 32) (bvsub (|output_gate#78| state) #b00000000000000000000000000000001)) ; $sub$output_gate.v:115$34_Y
(define-fun |output_gate#137| ((state |output_gate_s|)) (_ BitVec 32) (ite (= ((_ extract 0 0) (|output_gate#79| state)) #b1) (|output_gate#136| state) (|output_gate#78| state))) ; $procmux$256_Y
(define-fun |output_gate#138| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#133| state) #b00000000111011100110101100101000 (|output_gate#137| state))) ; $procmux$259_Y
(define-fun |output_gate#139| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#81| state) #b00000000000000000000000000000000 (|output_gate#138| state))) ; $0\rest_left_q[31:0]
(define-fun |output_gate#140| ((state |output_gate_s|)) (_ BitVec 3) (bvand (concat ((_ extract 1 0) (|output_gate#69| state)) (ite (|output_gate#49| state) #b1 #b0)) (concat (ite (|output_gate#71| state) #b1 #b0) (concat (ite (|output_gate#71| state) #b1 #b0) (ite (|output_gate#71| state) #b1 #b0))))) ; $and$output_gate.v:136$44_Y
(define-fun |output_gate#141| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#81| state) #b000 (|output_gate#140| state))) ; $0\on_later_q[2:0]
(define-fun |output_gate#142| ((state |output_gate_s|)) (_ BitVec 3) (bvand (concat ((_ extract 1 0) (|output_gate#64| state)) (ite (|output_gate#48| state) #b1 #b0)) (concat (ite (|output_gate#71| state) #b1 #b0) (concat (ite (|output_gate#71| state) #b1 #b0) (ite (|output_gate#71| state) #b1 #b0))))) ; $and$output_gate.v:137$45_Y
(define-fun |output_gate#143| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#81| state) #b000 (|output_gate#142| state))) ; $0\moves_later_q[2:0]
(define-fun |output_gate#144| ((state |output_gate_s|)) (_ BitVec 16) (bvsub (|output_gate#57| state) #b0000000000000001)) ; $sub$output_gate.v:143$57_Y
(define-fun |output_gate#145| ((state |output_gate_s|)) Bool (distinct (|output_gate#57| state) #b0000000000000000)) ; $ne$output_gate.v:143$56_Y
(define-fun |output_gate#146| ((state |output_gate_s|)) (_ BitVec 16) (ite (|output_gate#145| state) (|output_gate#144| state) (|output_gate#57| state))) ; $procmux$227_Y
(define-fun |output_gate#147| ((state |output_gate_s|)) (_ BitVec 16) (bvsub (|output_gate#25| state) #b0000000000000001)) ; $sub$output_gate.v:142$55_Y
(define-fun |output_gate#148| ((state |output_gate_s|)) (_ BitVec 16) (ite (|output_gate#41| state) (|output_gate#147| state) (|output_gate#146| state))) ; $procmux$230_Y
(define-fun |output_gate#149| ((state |output_gate_s|)) (_ BitVec 16) (ite (|output_gate#72| state) (|output_gate#148| state) #b0000000000000000)) ; $procmux$233_Y
(define-fun |output_gate#150| ((state |output_gate_s|)) (_ BitVec 16) (ite (|output_gate#81| state) #b0000000000000000 (|output_gate#149| state))) ; $0\focus_left_q[15:0]
(define-fun |output_gate#151| ((state |output_gate_s|)) Bool (distinct (|output_gate#80| state) #b000000000)) ; $ne$output_gate.v:110$30_Y
(define-fun |output_gate#152| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#34| state) (ite (|output_gate#151| state) #b1 #b0) (|output_gate#56| state))) ; $ternary$output_gate.v:110$31_Y
(define-fun |output_gate#153| ((state |output_gate_s|)) Bool (or  (= ((_ extract 0 0) (|output_gate#152| state)) #b1) false  (|output_gate#84| state) false)) ; $logic_or$output_gate.v:110$32_Y
(define-fun |output_gate#154| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#81| state) #b0 (ite (|output_gate#153| state) #b1 #b0))) ; $0\faulted_q[0:0]
(define-fun |output_gate#155| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#56| state)) #b1) false))) ; $logic_not$output_gate.v:118$36_Y
(define-fun |output_gate#156| ((state |output_gate_s|)) Bool (and (or  (|output_gate#84| state) false) (or  (|output_gate#155| state) false))) ; $logic_and$output_gate.v:118$37_Y
(define-fun |output_gate#157| ((state |output_gate_s|)) (_ BitVec 64) (ite (|output_gate#156| state) (|output_gate#68| state) (|output_gate#55| state))) ; $procmux$237_Y
(define-fun |output_gate#158| ((state |output_gate_s|)) (_ BitVec 64) (ite (|output_gate#81| state) #b0000000000000000000000000000000000000000000000000000000000000000 (|output_gate#157| state))) ; $0\fault_time_q[63:0]
(define-fun |output_gate#159| ((state |output_gate_s|)) (_ BitVec 9) (ite (|output_gate#34| state) (|output_gate#80| state) (|output_gate#54| state))) ; $ternary$output_gate.v:109$28_Y
(define-fun |output_gate#160| ((state |output_gate_s|)) (_ BitVec 9) (bvor (|output_gate#159| state) (|output_gate#32| state))) ; $or$output_gate.v:109$29_Y
(define-fun |output_gate#161| ((state |output_gate_s|)) (_ BitVec 9) (ite (|output_gate#81| state) #b000000000 (|output_gate#160| state))) ; $0\fault_q[8:0]
(define-fun |output_gate#162| ((state |output_gate_s|)) (_ BitVec 32) (bvadd (|output_gate#53| state) #b00000000000000000000000000000001)) ; $add$output_gate.v:119$38_Y
(define-fun |output_gate#163| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#156| state) (|output_gate#162| state) (|output_gate#53| state))) ; $procmux$245_Y
(define-fun |output_gate#164| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#81| state) #b00000000000000000000000000000000 (|output_gate#163| state))) ; $0\fault_count_q[31:0]
(define-fun |output_gate#165| ((state |output_gate_s|)) Bool (bvule (|output_gate#18| state) #b101)) ; $0\exists_1_q[0:0]
(define-fun |output_gate#166| ((state |output_gate_s|)) (_ BitVec 32) (bvadd (|output_gate#40| state) #b00000000000000000000000000000001)) ; $add$output_gate.v:140$53_Y
(define-fun |output_gate#167| ((state |output_gate_s|)) Bool (and (or  (|output_gate#41| state) false) (or  (|output_gate#72| state) false))) ; $logic_and$output_gate.v:140$52_Y
(define-fun |output_gate#168| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#167| state) (|output_gate#166| state) (|output_gate#40| state))) ; $procmux$223_Y
(define-fun |output_gate#169| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#81| state) #b00000000000000000000000000000000 (|output_gate#168| state))) ; $0\emissions_q[31:0]
(define-fun |output_gate#170| ((state |output_gate_s|)) Bool (not (or  (|output_gate#84| state) false))) ; $logic_not$output_gate.v:138$46_Y
(define-fun |output_gate#171| ((state |output_gate_s|)) Bool (and (or  (|output_gate#16| state) false) (or  (|output_gate#170| state) false))) ; $logic_and$output_gate.v:138$47_Y
(define-fun |output_gate#172| ((state |output_gate_s|)) Bool (distinct (|output_gate#69| state) #b000)) ; $ne$output_gate.v:138$48_Y
(define-fun |output_gate#173| ((state |output_gate_s|)) Bool (or  (|output_gate#49| state) false  (|output_gate#172| state) false)) ; $logic_or$output_gate.v:138$49_Y
(define-fun |output_gate#174| ((state |output_gate_s|)) Bool (and (or  (|output_gate#71| state) false) (or  (|output_gate#173| state) false))) ; $logic_and$output_gate.v:138$50_Y
(define-fun |output_gate#175| ((state |output_gate_s|)) Bool (or  (|output_gate#171| state) false  (|output_gate#174| state) false)) ; $logic_or$output_gate.v:138$51_Y
(define-fun |output_gate#176| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#81| state) #b0 (ite (|output_gate#175| state) #b1 #b0))) ; $0\live_q[0:0]
(define-fun |output_gate#177| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#74| state) #b000 (|output_gate#18| state))) ; $procmux$278_Y
(define-fun |output_gate#178| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#83| state) #b100 (|output_gate#18| state))) ; $procmux$282_Y
(define-fun |output_gate#179| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#37| state) #b011 (|output_gate#18| state))) ; $procmux$285_Y
(define-fun |output_gate#180| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#74| state) #b010 (|output_gate#18| state))) ; $procmux$288_Y
(define-fun |output_gate#181| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#37| state) #b100 (|output_gate#180| state))) ; $procmux$291_Y
(define-fun |output_gate#182| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#82| state)) #b1) (= ((_ extract 1 1) (|output_gate#82| state)) #b1) (= ((_ extract 2 2) (|output_gate#82| state)) #b1) (= ((_ extract 3 3) (|output_gate#82| state)) #b1) (= ((_ extract 4 4) (|output_gate#82| state)) #b1) (= ((_ extract 5 5) (|output_gate#82| state)) #b1) (= ((_ extract 6 6) (|output_gate#82| state)) #b1) (= ((_ extract 7 7) (|output_gate#82| state)) #b1) (= ((_ extract 8 8) (|output_gate#82| state)) #b1) (= ((_ extract 9 9) (|output_gate#82| state)) #b1) (= ((_ extract 10 10) (|output_gate#82| state)) #b1) (= ((_ extract 11 11) (|output_gate#82| state)) #b1) (= ((_ extract 12 12) (|output_gate#82| state)) #b1) (= ((_ extract 13 13) (|output_gate#82| state)) #b1) (= ((_ extract 14 14) (|output_gate#82| state)) #b1) (= ((_ extract 15 15) (|output_gate#82| state)) #b1)))) ; $eq$output_gate.v:126$41_Y
(define-fun |output_gate#183| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#182| state) #b001 (|output_gate#18| state))) ; $procmux$294_Y
(define-fun |output_gate#184| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#37| state) #b000 (|output_gate#183| state))) ; $procmux$297_Y
(define-fun |output_gate#185| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#16| state) #b101 (|output_gate#18| state))) ; $procmux$300_Y
(define-fun |output_gate#186| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#50| state) (|output_gate#185| state) (ite (|output_gate#42| state) (|output_gate#184| state) (ite (|output_gate#43| state) (|output_gate#181| state) (ite (|output_gate#19| state) (|output_gate#179| state) (ite (|output_gate#45| state) (|output_gate#178| state) (ite (|output_gate#47| state) (|output_gate#177| state) #b000))))))) ; $procmux$280_Y
(define-fun |output_gate#187| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#84| state) #b000 (|output_gate#186| state))) ; $procmux$303_Y
(define-fun |output_gate#188| ((state |output_gate_s|)) (_ BitVec 3) (ite (|output_gate#81| state) #b000 (|output_gate#187| state))) ; $0\state_q[2:0]
(define-fun |output_gate#189| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 1 1) (|output_gate#85| state)) #b1) (= ((_ extract 2 2) (|output_gate#85| state)) #b1) (= ((_ extract 3 3) (|output_gate#85| state)) #b1) (= ((_ extract 4 4) (|output_gate#85| state)) #b1) (= ((_ extract 5 5) (|output_gate#85| state)) #b1) (= ((_ extract 6 6) (|output_gate#85| state)) #b1) (= ((_ extract 7 7) (|output_gate#85| state)) #b1) (= ((_ extract 8 8) (|output_gate#85| state)) #b1) (= ((_ extract 9 9) (|output_gate#85| state)) #b1) (= ((_ extract 10 10) (|output_gate#85| state)) #b1) (= ((_ extract 11 11) (|output_gate#85| state)) #b1) (= ((_ extract 12 12) (|output_gate#85| state)) #b1) (= ((_ extract 13 13) (|output_gate#85| state)) #b1) (= ((_ extract 14 14) (|output_gate#85| state)) #b1) (= ((_ extract 15 15) (|output_gate#85| state)) #b1) (= ((_ extract 16 16) (|output_gate#85| state)) #b1) (= ((_ extract 17 17) (|output_gate#85| state)) #b1) (= ((_ extract 18 18) (|output_gate#85| state)) #b1) (= ((_ extract 19 19) (|output_gate#85| state)) #b1) (= ((_ extract 20 20) (|output_gate#85| state)) #b1) (= ((_ extract 21 21) (|output_gate#85| state)) #b1) (= ((_ extract 22 22) (|output_gate#85| state)) #b1) (= ((_ extract 23 23) (|output_gate#85| state)) #b1) (= ((_ extract 24 24) (|output_gate#85| state)) #b1) (= ((_ extract 25 25) (|output_gate#85| state)) #b1) (= ((_ extract 26 26) (|output_gate#85| state)) #b1) (= ((_ extract 27 27) (|output_gate#85| state)) #b1) (= ((_ extract 28 28) (|output_gate#85| state)) #b1) (= ((_ extract 29 29) (|output_gate#85| state)) #b1) (= ((_ extract 30 30) (|output_gate#85| state)) #b1) (= ((_ extract 31 31) (|output_gate#85| state)) #b1)))) ; $eq$output_gate.v:106$27_Y
(define-fun |output_gate#190| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#5| state)) #b1) #b1 (ite (|output_gate#189| state) #b1 #b0))) ; $procmux$263_Y
(define-fun |output_gate#191| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#58| state) #b0 (|output_gate#190| state))) ; $procmux$266_Y
(define-fun |output_gate#192| ((state |output_gate_s|)) (_ BitVec 1) (ite (|output_gate#81| state) #b1 (|output_gate#191| state))) ; $0\silent_q[0:0]
(define-fun |output_gate#193| ((state |output_gate_s|)) (_ BitVec 11) (bvsub (|output_gate#4| state) #b00000000001)) ; $sub$output_gate.v:146$60_Y
(define-fun |output_gate#194| ((state |output_gate_s|)) Bool (not (or  (= ((_ extract 0 0) (|output_gate#4| state)) #b1) (= ((_ extract 1 1) (|output_gate#4| state)) #b1) (= ((_ extract 2 2) (|output_gate#4| state)) #b1) (= ((_ extract 3 3) (|output_gate#4| state)) #b1) (= ((_ extract 4 4) (|output_gate#4| state)) #b1) (= ((_ extract 5 5) (|output_gate#4| state)) #b1) (= ((_ extract 6 6) (|output_gate#4| state)) #b1) (= ((_ extract 7 7) (|output_gate#4| state)) #b1) (= ((_ extract 8 8) (|output_gate#4| state)) #b1) (= ((_ extract 9 9) (|output_gate#4| state)) #b1) (= ((_ extract 10 10) (|output_gate#4| state)) #b1)))) ; $eq$output_gate.v:145$59_Y
(define-fun |output_gate#195| ((state |output_gate_s|)) (_ BitVec 11) (ite (|output_gate#194| state) #b11111001111 (|output_gate#193| state))) ; $procmux$204_Y
(define-fun |output_gate#196| ((state |output_gate_s|)) (_ BitVec 11) (ite (|output_gate#72| state) (|output_gate#195| state) #b00000000000)) ; $procmux$207_Y
(define-fun |output_gate#197| ((state |output_gate_s|)) (_ BitVec 11) (ite (|output_gate#81| state) #b00000000000 (|output_gate#196| state))) ; $0\alive_left_q[10:0]
(define-fun |output_gate#198| ((state |output_gate_s|)) Bool (not (or  (|output_gate#81| state) false))) ; $logic_not$output_gate.v:177$63_Y
(define-fun |output_gate#199| ((state |output_gate_s|)) Bool (and (or  (|output_gate#72| state) false) (or  (|output_gate#198| state) false))) ; $0\hv_enable_q[0:0]
(define-fun |output_gate#200| ((state |output_gate_s|)) (_ BitVec 1) (bvxor (|output_gate#12| state) (ite (|output_gate#194| state) #b1 #b0))) ; $xor$output_gate.v:179$72_Y
(define-fun |output_gate#201| ((state |output_gate_s|)) Bool (and (or  (|output_gate#199| state) false) (or  (= ((_ extract 0 0) (|output_gate#200| state)) #b1) false))) ; $0\hv_alive_q[0:0]
(define-fun |output_gate#202| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#7| state)) #b1) #b0 (ite (|output_gate#201| state) #b1 #b0))) ; $auto$rtlil.cc:3381:Mux$479
(define-fun |output_gate#203| ((state |output_gate_s|)) Bool (or  (|output_gate#41| state) false  (|output_gate#145| state) false)) ; $logic_or$output_gate.v:180$77_Y
(define-fun |output_gate#204| ((state |output_gate_s|)) Bool (and (or  (|output_gate#199| state) false) (or  (|output_gate#203| state) false))) ; $0\focus_q[0:0]
(define-fun |output_gate#205| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#7| state)) #b1) #b0 (ite (|output_gate#204| state) #b1 #b0))) ; $auto$rtlil.cc:3381:Mux$481
(define-fun |output_gate#206| ((state |output_gate_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|output_gate#7| state)) #b1) #b0 (ite (|output_gate#199| state) #b1 #b0))) ; $auto$rtlil.cc:3381:Mux$483
(define-fun |output_gate#207| ((state |output_gate_s|)) (_ BitVec 32) (bvand (|output_gate#39| state) (|output_gate#33| state))) ; $and$output_gate.v:177$65_Y
(define-fun |output_gate#208| ((state |output_gate_s|)) Bool (and (or  (|output_gate#72| state) false) (or  (= ((_ extract 2 2) (|output_gate#64| state)) #b1) false))) ; $logic_and$output_gate.v:177$62_Y
(define-fun |output_gate#209| ((state |output_gate_s|)) Bool (and (or  (|output_gate#208| state) false) (or  (|output_gate#198| state) false))) ; $logic_and$output_gate.v:177$64_Y
(define-fun |output_gate#210| ((state |output_gate_s|)) (_ BitVec 32) (ite (|output_gate#209| state) (|output_gate#207| state) #b00000000000000000000000000000000)) ; $0\channel_q[31:0]
(define-fun |output_gate#211| ((state |output_gate_s|)) (_ BitVec 32) (ite (= ((_ extract 0 0) (|output_gate#7| state)) #b1) #b00000000000000000000000000000000 (|output_gate#210| state))) ; $auto$rtlil.cc:3381:Mux$485
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
))
(define-fun |output_gate_u| ((state |output_gate_s|)) Bool (and
  (|output_gate_u 0| state)
  (|output_gate_u 1| state)
  (|output_gate_u 2| state)
))
(define-fun |output_gate_i| ((state |output_gate_s|)) Bool 
  (= (= ((_ extract 0 0) (|output_gate#23| state)) #b1) false) ; started_q
)
(define-fun |output_gate_h| ((state |output_gate_s|)) Bool true)
(define-fun |output_gate_t| ((state |output_gate_s|) (next_state |output_gate_s|)) Bool (and
  (= (|output_gate#123| state) (|output_gate#94| next_state)) ; $procdff$351 \underruns_q
  (= ((_ extract 0 0) (|output_gate#30| state)) (|output_gate#91| next_state)) ; $procdff$399 \underrun_1_q
  (= (|output_gate#5| state) (|output_gate#86| next_state)) ; $procdff$376 \silent_1_q
  (= (|output_gate#127| state) (|output_gate#85| next_state)) ; $procdff$344 \silence_q
  (= (|output_gate#130| state) (|output_gate#82| next_state)) ; $procdff$353 \settle_left_q
  (= (|output_gate#135| state) (|output_gate#79| next_state)) ; $procdff$349 \resting_q
  (= (|output_gate#139| state) (|output_gate#78| next_state)) ; $procdff$348 \rest_left_q
  (= (ite (|output_gate#81| state) #b1 #b0) (|output_gate#75| next_state)) ; $procdff$373 \rst_1_q
  (= (ite (|output_gate#26| state) #b1 #b0) (|output_gate#73| next_state)) ; $procdff$374 \permit_1_q
  (= (|output_gate#141| state) (|output_gate#69| next_state)) ; $procdff$354 \on_later_q
  (= (|output_gate#143| state) (|output_gate#64| next_state)) ; $procdff$355 \moves_later_q
  (= (|output_gate#33| state) (|output_gate#62| next_state)) ; $procdff$378 \mask_1_q
  (= (|output_gate#150| state) (|output_gate#57| next_state)) ; $procdff$357 \focus_left_q
  (= (|output_gate#154| state) (|output_gate#56| next_state)) ; $procdff$347 \faulted_q
  (= (|output_gate#158| state) (|output_gate#55| next_state)) ; $procdff$352 \fault_time_q
  (= (|output_gate#161| state) (|output_gate#54| next_state)) ; $procdff$346 \fault_q
  (= (|output_gate#164| state) (|output_gate#53| next_state)) ; $procdff$350 \fault_count_q
  (= (ite (|output_gate#165| state) #b1 #b0) (|output_gate#52| next_state)) ; $procdff$377 \exists_1_q
  (= (|output_gate#169| state) (|output_gate#40| next_state)) ; $procdff$358 \emissions_q
  (= (|output_gate#39| state) (|output_gate#38| next_state)) ; $procdff$402 \drive_1_q
  (= (ite (|output_gate#28| state) #b1 #b0) (|output_gate#36| next_state)) ; $procdff$375 \cool_1_q
  (= (|output_gate#176| state) (|output_gate#31| next_state)) ; $procdff$356 \live_q
  (= #b1 (|output_gate#23| next_state)) ; $procdff$372 \started_q
  (= ((_ extract 5 1) (|output_gate#30| state)) (|output_gate#20| next_state)) ; $procdff$379 \limits_1_q
  (= (|output_gate#188| state) (|output_gate#18| next_state)) ; $procdff$343 \state_q
  (= (|output_gate#192| state) (|output_gate#5| next_state)) ; $procdff$345 \silent_q
  (= (|output_gate#197| state) (|output_gate#4| next_state)) ; $procdff$359 \alive_left_q
  (= (|output_gate#202| state) (|output_gate#3| next_state)) ; $procdff$371 \_witness_.anyinit_procdff_371
  (= (|output_gate#205| state) (|output_gate#2| next_state)) ; $procdff$368 \_witness_.anyinit_procdff_368
  (= (|output_gate#206| state) (|output_gate#1| next_state)) ; $procdff$365 \_witness_.anyinit_procdff_365
  (= (|output_gate#211| state) (|output_gate#0| next_state)) ; $procdff$362 \_witness_.anyinit_procdff_362
)) ; end of module output_gate
