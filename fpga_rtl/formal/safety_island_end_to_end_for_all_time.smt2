; of 07083d27a3a9da38f484e42a217bbc90ab5c9ecfedb93fe893294c1f5f583594, by python -m tests.rtl.proofs
(declare-sort |safety_island_s| 0)
(declare-fun |safety_island_is| (|safety_island_s|) Bool)
(declare-fun |safety_island#0| (|safety_island_s|) (_ BitVec 4)) ; \_witness_.anyseq_auto_setundef_cc_550_execute_3254
(define-fun |safety_island_n _witness_.anyseq_auto_setundef_cc_550_execute_3254| ((state |safety_island_s|)) (_ BitVec 4) (|safety_island#0| state))
(declare-fun |safety_island#1| (|safety_island_s|) (_ BitVec 21)) ; \_witness_.anyseq_auto_setundef_cc_550_execute_3252
(define-fun |safety_island_n _witness_.anyseq_auto_setundef_cc_550_execute_3252| ((state |safety_island_s|)) (_ BitVec 21) (|safety_island#1| state))
(declare-fun |safety_island#2| (|safety_island_s|) (_ BitVec 32)) ; \_witness_.anyinit_flatten_output_gate__procdff_2582
(define-fun |safety_island_n _witness_.anyinit_flatten_output_gate__procdff_2582| ((state |safety_island_s|)) (_ BitVec 32) (|safety_island#2| state))
(declare-fun |safety_island#3| (|safety_island_s|) (_ BitVec 1)) ; \clear_1_g
(define-fun |safety_island#4| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#3| state)) #b1) #b0 #b1)) ; $procmux$1645_Y
(declare-fun |safety_island#5| (|safety_island_s|) (_ BitVec 5)) ; \run_g
(declare-fun |safety_island#6| (|safety_island_s|) Bool) ; \rst_i
(define-fun |safety_island#7| ((state |safety_island_s|)) Bool (not (or  (|safety_island#6| state) false))) ; $flatten\output_gate.$logic_not$output_gate.v:177$889_Y
(define-fun |safety_island#8| ((state |safety_island_s|)) Bool (and (or  (= ((_ extract 0 0) (|safety_island#5| state)) #b1) false) (or  (|safety_island#7| state) false))) ; \since_reset
(define-fun |safety_island#9| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#8| state) (|safety_island#4| state) #b0)) ; \a_fault_is_kept_EN
(define-fun |safety_island_n a_fault_is_kept_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#9| state)) #b1))
(declare-fun |safety_island#10| (|safety_island_s|) Bool) ; \playing_i
(declare-fun |safety_island#11| (|safety_island_s|) (_ BitVec 3)) ; \output_gate.state_q
(define-fun |safety_island#12| ((state |safety_island_s|)) Bool (= (|safety_island#11| state) #b001)) ; \ramp_up_o
(define-fun |safety_island#13| ((state |safety_island_s|)) Bool (or  (|safety_island#10| state) false  (|safety_island#12| state) false)) ; $logic_or$safety_island.v:151$248_Y
(define-fun |safety_island#14| ((state |safety_island_s|)) Bool (= (|safety_island#11| state) #b100)) ; \ramp_down_o
(define-fun |safety_island#15| ((state |safety_island_s|)) Bool (or  (|safety_island#13| state) false  (|safety_island#14| state) false)) ; \active
(define-fun |safety_island_n active| ((state |safety_island_s|)) Bool (|safety_island#15| state))
(declare-fun |safety_island#16| (|safety_island_s|) (_ BitVec 1)) ; \alive_1_g
(define-fun |safety_island_n alive_1_g| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#16| state)) #b1))
(declare-fun |safety_island#17| (|safety_island_s|) (_ BitVec 1)) ; \output_gate.silent_q
(define-fun |safety_island#18| ((state |safety_island_s|)) Bool (not (or  (= ((_ extract 0 0) (|safety_island#17| state)) #b1) false))) ; \output_gate.alive_o
(define-fun |safety_island_n alive_o| ((state |safety_island_s|)) Bool (|safety_island#18| state))
(declare-fun |safety_island#19| (|safety_island_s|) (_ BitVec 1)) ; \allowed_g
(define-fun |safety_island_n allowed_g| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#19| state)) #b1))
(declare-fun |safety_island#20| (|safety_island_s|) (_ BitVec 1)) ; \output_gate.live_q
(define-fun |safety_island#21| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#20| state)) #b1) #b1 #b0)) ; $flatten\output_gate.$procmux$2058_Y
(declare-fun |safety_island#22| (|safety_island_s|) (_ BitVec 1)) ; \output_gate.started_q
(declare-fun |safety_island#23| (|safety_island_s|) Bool) ; \clock_lost_i
(define-fun |safety_island#24| ((state |safety_island_s|)) Bool (not (or  (|safety_island#23| state) false))) ; $flatten\output_gate.$logic_not$output_gate_properties.vh:38$919_Y
(define-fun |safety_island#25| ((state |safety_island_s|)) Bool (and (or  (= ((_ extract 0 0) (|safety_island#22| state)) #b1) false) (or  (|safety_island#24| state) false))) ; $logic_and$safety_island_end_to_end_links.vh:28$507_Y
(define-fun |safety_island#26| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#25| state) (|safety_island#21| state) #b0)) ; \allowed_is_linked_EN
(define-fun |safety_island_n allowed_is_linked_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#26| state)) #b1))
(define-fun |safety_island#27| ((state |safety_island_s|)) (_ BitVec 32) (ite (|safety_island#23| state) #b00000000000000000000000000000000 (|safety_island#2| state))) ; \output_gate.channel_q
(define-fun |safety_island#28| ((state |safety_island_s|)) Bool (distinct (|safety_island#27| state) #b00000000000000000000000000000000)) ; $flatten\output_gate.$ne$output_gate_properties.vh:146$1184_Y
(declare-fun |safety_island#29| (|safety_island_s|) (_ BitVec 1)) ; \_witness_.anyinit_flatten_output_gate__procdff_2585
(define-fun |safety_island#30| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#23| state) #b0 (|safety_island#29| state))) ; \output_gate.hv_enable_q
(define-fun |safety_island#31| ((state |safety_island_s|)) Bool (or  (|safety_island#28| state) false  (= ((_ extract 0 0) (|safety_island#30| state)) #b1) false)) ; $flatten\output_gate.$logic_or$output_gate_properties.vh:83$1002_Y
(declare-fun |safety_island#32| (|safety_island_s|) (_ BitVec 1)) ; \_witness_.anyinit_flatten_output_gate__procdff_2591
(define-fun |safety_island#33| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#23| state) #b0 (|safety_island#32| state))) ; \output_gate.hv_alive_q
(define-fun |safety_island#34| ((state |safety_island_s|)) Bool (or  (|safety_island#31| state) false  (= ((_ extract 0 0) (|safety_island#33| state)) #b1) false)) ; $flatten\output_gate.$logic_or$output_gate_properties.vh:83$1003_Y
(declare-fun |safety_island#35| (|safety_island_s|) (_ BitVec 1)) ; \_witness_.anyinit_flatten_output_gate__procdff_2588
(define-fun |safety_island#36| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#23| state) #b0 (|safety_island#35| state))) ; \output_gate.focus_q
(define-fun |safety_island#37| ((state |safety_island_s|)) Bool (or  (|safety_island#34| state) false  (= ((_ extract 0 0) (|safety_island#36| state)) #b1) false)) ; \output_gate.any
(define-fun |safety_island_n any| ((state |safety_island_s|)) Bool (|safety_island#37| state))
(define-fun |safety_island#38| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#22| state)) #b1) #b1 #b0)) ; \any_fault_is_known_EN
(define-fun |safety_island_n any_fault_is_known_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#38| state)) #b1))
(declare-fun |safety_island#39| (|safety_island_s|) Bool) ; \arm_i
(define-fun |safety_island#40| ((state |safety_island_s|)) Bool (not (or  (= ((_ extract 0 0) (|safety_island#11| state)) #b1) (= ((_ extract 1 1) (|safety_island#11| state)) #b1) (= ((_ extract 2 2) (|safety_island#11| state)) #b1)))) ; \off_o
(define-fun |safety_island#41| ((state |safety_island_s|)) Bool (and (or  (|safety_island#39| state) false) (or  (|safety_island#40| state) false))) ; $logic_and$safety_island.v:111$229_Y
(declare-fun |safety_island#42| (|safety_island_s|) (_ BitVec 1)) ; \output_gate.faulted_q
(define-fun |safety_island#43| ((state |safety_island_s|)) Bool (not (or  (= ((_ extract 0 0) (|safety_island#42| state)) #b1) false))) ; $flatten\output_gate.$logic_not$output_gate.v:118$862_Y
(define-fun |safety_island#44| ((state |safety_island_s|)) Bool (and (or  (|safety_island#41| state) false) (or  (|safety_island#43| state) false))) ; $logic_and$safety_island.v:111$231_Y
(declare-fun |safety_island#45| (|safety_island_s|) (_ BitVec 2)) ; \run_permit_q
(define-fun |safety_island#46| ((state |safety_island_s|)) Bool (and (or  (|safety_island#44| state) false) (or  (= ((_ extract 1 1) (|safety_island#45| state)) #b1) false))) ; $logic_and$safety_island.v:111$232_Y
(declare-fun |safety_island#47| (|safety_island_s|) (_ BitVec 2)) ; \temperature_ok_q
(define-fun |safety_island#48| ((state |safety_island_s|)) Bool (and (or  (|safety_island#46| state) false) (or  (= ((_ extract 1 1) (|safety_island#47| state)) #b1) false))) ; \arm
(define-fun |safety_island_n arm| ((state |safety_island_s|)) Bool (|safety_island#48| state))
(declare-fun |safety_island#49| (|safety_island_s|) (_ BitVec 1)) ; \arm_1_q
(define-fun |safety_island_n arm_1_q| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#49| state)) #b1))
(define-fun |safety_island_n arm_i| ((state |safety_island_s|)) Bool (|safety_island#39| state))
(define-fun |safety_island_n _witness_.anyinit_flatten_output_gate__procdff_2585| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#29| state)) #b1))
(define-fun |safety_island#50| ((state |safety_island_s|)) Bool (= (|safety_island#11| state) #b010)) ; \armed_o
(define-fun |safety_island_n armed_o| ((state |safety_island_s|)) Bool (|safety_island#50| state))
(define-fun |safety_island_n _witness_.anyinit_flatten_output_gate__procdff_2588| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#35| state)) #b1))
(declare-fun |safety_island#51| (|safety_island_s|) (_ BitVec 1)) ; \armer_g
(define-fun |safety_island_n armer_g| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#51| state)) #b1))
(define-fun |safety_island#52| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#25| state) #b1 #b0)) ; \armer_is_linked_EN
(define-fun |safety_island_n armer_is_linked_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#52| state)) #b1))
(define-fun |safety_island#53| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#48| state) #b1 #b0)) ; $procmux$1720_Y
(define-fun |safety_island#54| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#22| state)) #b1) (|safety_island#53| state) #b0)) ; \arming_is_safe_EN
(define-fun |safety_island_n arming_is_safe_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#54| state)) #b1))
(declare-fun |safety_island#55| (|safety_island_s|) (_ BitVec 1)) ; \permit_2_g
(define-fun |safety_island#56| ((state |safety_island_s|)) Bool (and (or  (|safety_island#44| state) false) (or  (= ((_ extract 0 0) (|safety_island#55| state)) #b1) false))) ; $logic_and$safety_island_end_to_end_properties.vh:38$273_Y
(declare-fun |safety_island#57| (|safety_island_s|) (_ BitVec 1)) ; \cool_2_g
(define-fun |safety_island#58| ((state |safety_island_s|)) Bool (and (or  (|safety_island#56| state) false) (or  (= ((_ extract 0 0) (|safety_island#57| state)) #b1) false))) ; \arms
(define-fun |safety_island_n arms| ((state |safety_island_s|)) Bool (|safety_island#58| state))
(declare-fun |safety_island#59| (|safety_island_s|) (_ BitVec 32)) ; \beat_g
(define-fun |safety_island_n beat_g| ((state |safety_island_s|)) (_ BitVec 32) (|safety_island#59| state))
(define-fun |safety_island#60| ((state |safety_island_s|)) Bool (and (or  (|safety_island#8| state) false) (or  (= ((_ extract 0 0) (|safety_island#30| state)) #b1) false))) ; $logic_and$safety_island_end_to_end_links.vh:40$537_Y
(define-fun |safety_island#61| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#60| state) #b1 #b0)) ; $procmux$1792_Y
(define-fun |safety_island#62| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#25| state) (|safety_island#61| state) #b0)) ; \beat_is_linked_EN
(define-fun |safety_island_n beat_is_linked_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#62| state)) #b1))
(declare-fun |safety_island#63| (|safety_island_s|) (_ BitVec 16)) ; \bit_ticks_i
(define-fun |safety_island_n bit_ticks_i| ((state |safety_island_s|)) (_ BitVec 16) (|safety_island#63| state))
(declare-fun |safety_island#64| (|safety_island_s|) (_ BitVec 32)) ; \channel_1_g
(define-fun |safety_island_n channel_1_g| ((state |safety_island_s|)) (_ BitVec 32) (|safety_island#64| state))
(declare-fun |safety_island#65| (|safety_island_s|) (_ BitVec 32)) ; \channel_edges_i
(define-fun |safety_island_n channel_edges_i| ((state |safety_island_s|)) (_ BitVec 32) (|safety_island#65| state))
(declare-fun |safety_island#66| (|safety_island_s|) (_ BitVec 14)) ; \channel_edges_q
(define-fun |safety_island_n channel_edges_q| ((state |safety_island_s|)) (_ BitVec 14) (|safety_island#66| state))
(declare-fun |safety_island#67| (|safety_island_s|) (_ BitVec 32)) ; \channel_mask_i
(define-fun |safety_island_n channel_mask_i| ((state |safety_island_s|)) (_ BitVec 32) (|safety_island#67| state))
(define-fun |safety_island_n channel_o| ((state |safety_island_s|)) (_ BitVec 32) (|safety_island#27| state))
(define-fun |safety_island_n clear_1_g| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#3| state)) #b1))
(declare-fun |safety_island#68| (|safety_island_s|) Bool) ; \clear_i
(define-fun |safety_island_n clear_i| ((state |safety_island_s|)) Bool (|safety_island#68| state))
(declare-fun |safety_island#69| (|safety_island_s|) Bool) ; \clk_i
(define-fun |safety_island_n clk_i| ((state |safety_island_s|)) Bool (|safety_island#69| state))
(define-fun |safety_island_n clock_is_lost_in_reset_EN| ((state |safety_island_s|)) Bool true)
(define-fun |safety_island_n clock_lost_i| ((state |safety_island_s|)) Bool (|safety_island#23| state))
(declare-fun |safety_island#70| (|safety_island_s|) (_ BitVec 1)) ; \cool_1_g
(define-fun |safety_island_n cool_1_g| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#70| state)) #b1))
(define-fun |safety_island_n cool_2_g| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#57| state)) #b1))
(declare-fun |safety_island#71| (|safety_island_s|) (_ BitVec 1)) ; \cool_3_g
(define-fun |safety_island_n cool_3_g| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#71| state)) #b1))
(declare-fun |safety_island#72| (|safety_island_s|) (_ BitVec 32)) ; \stage_limits.channels_q
(define-fun |safety_island_n culprits| ((state |safety_island_s|)) (_ BitVec 32) (|safety_island#72| state))
(declare-fun |safety_island#73| (|safety_island_s|) (_ BitVec 9)) ; \output_gate.fault_q
(define-fun |safety_island#74| ((state |safety_island_s|)) Bool (or  (= ((_ extract 4 4) (|safety_island#73| state)) #b1) false  (= ((_ extract 5 5) (|safety_island#73| state)) #b1) false)) ; \culprits_known
(define-fun |safety_island_n culprits_known| ((state |safety_island_s|)) Bool (|safety_island#74| state))
(declare-fun |safety_island#75| (|safety_island_s|) Bool) ; \disarm_i
(define-fun |safety_island_n disarm_i| ((state |safety_island_s|)) Bool (|safety_island#75| state))
(declare-fun |safety_island#76| (|safety_island_s|) (_ BitVec 32)) ; \drive_1_g
(define-fun |safety_island_n drive_1_g| ((state |safety_island_s|)) (_ BitVec 32) (|safety_island#76| state))
(declare-fun |safety_island#77| (|safety_island_s|) (_ BitVec 32)) ; \drive_i
(define-fun |safety_island_n drive_i| ((state |safety_island_s|)) (_ BitVec 32) (|safety_island#77| state))
(declare-fun |safety_island#78| (|safety_island_s|) (_ BitVec 21)) ; \duty_1_q
(define-fun |safety_island_n duty_1_q| ((state |safety_island_s|)) (_ BitVec 21) (|safety_island#78| state))
(define-fun |safety_island_n duty_is_clamped_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#38| state)) #b1))
(define-fun |safety_island_n duty_is_linked_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#52| state)) #b1))
(define-fun |safety_island#79| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#8| state) #b1 #b0)) ; \duty_is_much_EN
(define-fun |safety_island_n duty_is_much_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#79| state)) #b1))
(declare-fun |safety_island#80| (|safety_island_s|) (_ BitVec 38)) ; \stage_limits.level_q
(define-fun |safety_island_n duty_level_o| ((state |safety_island_s|)) (_ BitVec 32) (concat #b0000000000 ((_ extract 37 16) (|safety_island#80| state))))
(declare-fun |safety_island#81| (|safety_island_s|) (_ BitVec 32)) ; \duty_most_g
(define-fun |safety_island_n duty_may| ((state |safety_island_s|)) (_ BitVec 39) (concat ((_ extract 22 0) (|safety_island#81| state)) #b0000000000000000))
(define-fun |safety_island_n duty_most_g| ((state |safety_island_s|)) (_ BitVec 32) (|safety_island#81| state))
(declare-fun |safety_island#82| (|safety_island_s|) (_ BitVec 17)) ; \duty_share_i
(define-fun |safety_island_n duty_share_i| ((state |safety_island_s|)) (_ BitVec 17) (|safety_island#82| state))
(declare-fun |safety_island#83| (|safety_island_s|) (_ BitVec 17)) ; \duty_share_q
(define-fun |safety_island_n duty_share_q| ((state |safety_island_s|)) (_ BitVec 17) (|safety_island#83| state))
(declare-fun |safety_island#84| (|safety_island_s|) (_ BitVec 32)) ; \duty_ticks_i
(define-fun |safety_island_n duty_ticks_i| ((state |safety_island_s|)) (_ BitVec 32) (|safety_island#84| state))
(declare-fun |safety_island#85| (|safety_island_s|) (_ BitVec 21)) ; \duty_ticks_q
(define-fun |safety_island_n duty_ticks_q| ((state |safety_island_s|)) (_ BitVec 21) (|safety_island#85| state))
(define-fun |safety_island#86| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 1 1) (|safety_island#5| state)) #b1) #b1 #b0)) ; $procmux$1633_Y
(define-fun |safety_island#87| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#8| state) (|safety_island#86| state) #b0)) ; \each_fault_counts_EN
(define-fun |safety_island_n each_fault_counts_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#87| state)) #b1))
(declare-fun |safety_island#88| (|safety_island_s|) (_ BitVec 1)) ; \edge_1_g
(define-fun |safety_island_n edge_1_g| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#88| state)) #b1))
(declare-fun |safety_island#89| (|safety_island_s|) (_ BitVec 5)) ; \one
(define-fun |safety_island#90| ((state |safety_island_s|)) (_ BitVec 1) ((_ extract 0 0) (bvlshr (|safety_island#27| state) (concat #b000000000000000000000000000 (|safety_island#89| state))))) ; $shiftx$safety_island_end_to_end_properties.vh:91$311_Y
(define-fun |safety_island#91| ((state |safety_island_s|)) (_ BitVec 1) ((_ extract 0 0) (bvlshr (|safety_island#64| state) (concat #b000000000000000000000000000 (|safety_island#89| state))))) ; $shiftx$safety_island_end_to_end_properties.vh:91$312_Y
(define-fun |safety_island#92| ((state |safety_island_s|)) Bool (distinct (|safety_island#90| state) (|safety_island#91| state))) ; \edge_one
(define-fun |safety_island_n edge_one| ((state |safety_island_s|)) Bool (|safety_island#92| state))
(declare-fun |safety_island#93| (|safety_island_s|) (_ BitVec 14)) ; \edges_1_q
(define-fun |safety_island_n edges_1_q| ((state |safety_island_s|)) (_ BitVec 14) (|safety_island#93| state))
(define-fun |safety_island_n edges_are_clamped_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#38| state)) #b1))
(define-fun |safety_island_n edges_are_of_the_pins_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#52| state)) #b1))
(declare-fun |safety_island#94| (|safety_island_s|) (_ BitVec 32)) ; \edges_most_g
(define-fun |safety_island_n edges_most_g| ((state |safety_island_s|)) (_ BitVec 32) (|safety_island#94| state))
(declare-fun |safety_island#95| (|safety_island_s|) (_ BitVec 18)) ; \emission_1_q
(define-fun |safety_island_n emission_1_q| ((state |safety_island_s|)) (_ BitVec 18) (|safety_island#95| state))
(define-fun |safety_island_n emission_is_clamped_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#38| state)) #b1))
(define-fun |safety_island_n emission_is_long_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#79| state)) #b1))
(declare-fun |safety_island#96| (|safety_island_s|) (_ BitVec 32)) ; \emission_most_g
(define-fun |safety_island_n emission_most_g| ((state |safety_island_s|)) (_ BitVec 32) (|safety_island#96| state))
(declare-fun |safety_island#97| (|safety_island_s|) (_ BitVec 32)) ; \emission_ticks_i
(define-fun |safety_island_n emission_ticks_i| ((state |safety_island_s|)) (_ BitVec 32) (|safety_island#97| state))
(declare-fun |safety_island#98| (|safety_island_s|) (_ BitVec 18)) ; \emission_ticks_q
(define-fun |safety_island_n emission_ticks_q| ((state |safety_island_s|)) (_ BitVec 18) (|safety_island#98| state))
(define-fun |safety_island#99| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#10| state) #b1 #b0)) ; $procmux$1768_Y
(define-fun |safety_island#100| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#25| state) (|safety_island#99| state) #b0)) ; \emissions_are_linked_EN
(define-fun |safety_island_n emissions_are_linked_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#100| state)) #b1))
(declare-fun |safety_island#101| (|safety_island_s|) (_ BitVec 32)) ; \output_gate.emissions_q
(define-fun |safety_island_n emissions_o| ((state |safety_island_s|)) (_ BitVec 32) (|safety_island#101| state))
(declare-fun |safety_island#102| (|safety_island_s|) Bool) ; \ended_i
(define-fun |safety_island_n ended_i| ((state |safety_island_s|)) Bool (|safety_island#102| state))
(define-fun |safety_island_n fault| ((state |safety_island_s|)) (_ BitVec 16) (concat #b0000000 (|safety_island#73| state)))
(declare-fun |safety_island#103| (|safety_island_s|) (_ BitVec 16)) ; \fault_1_g
(define-fun |safety_island_n fault_1_g| ((state |safety_island_s|)) (_ BitVec 16) (|safety_island#103| state))
(define-fun |safety_island#104| ((state |safety_island_s|)) (_ BitVec 32) (ite (|safety_island#74| state) (|safety_island#72| state) #b00000000000000000000000000000000)) ; \fault_channels_o
(define-fun |safety_island_n fault_channels_o| ((state |safety_island_s|)) (_ BitVec 32) (|safety_island#104| state))
(declare-fun |safety_island#105| (|safety_island_s|) (_ BitVec 32)) ; \fault_count_1_g
(define-fun |safety_island_n fault_count_1_g| ((state |safety_island_s|)) (_ BitVec 32) (|safety_island#105| state))
(declare-fun |safety_island#106| (|safety_island_s|) (_ BitVec 32)) ; \output_gate.fault_count_q
(define-fun |safety_island_n fault_count_o| ((state |safety_island_s|)) (_ BitVec 32) (|safety_island#106| state))
(define-fun |safety_island_n fault_o| ((state |safety_island_s|)) (_ BitVec 16) (concat #b0000000 (|safety_island#73| state)))
(declare-fun |safety_island#107| (|safety_island_s|) (_ BitVec 64)) ; \output_gate.fault_time_q
(define-fun |safety_island_n fault_time_o| ((state |safety_island_s|)) (_ BitVec 64) (|safety_island#107| state))
(declare-fun |safety_island#108| (|safety_island_s|) (_ BitVec 1)) ; \faulted_1_g
(define-fun |safety_island_n faulted_1_g| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#108| state)) #b1))
(define-fun |safety_island_n faulted_o| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#42| state)) #b1))
(declare-fun |safety_island#109| (|safety_island_s|) Bool) ; \heard_i
(define-fun |safety_island#110| ((state |safety_island_s|)) Bool (not (or  (|safety_island#40| state) false))) ; $flatten\output_gate.$logic_not$output_gate_properties.vh:76$980_Y
(define-fun |safety_island#111| ((state |safety_island_s|)) Bool (and (or  (|safety_island#109| state) false) (or  (|safety_island#110| state) false))) ; $logic_and$safety_island.v:112$235_Y
(declare-fun |safety_island#112| (|safety_island_s|) (_ BitVec 1)) ; \link_i
(define-fun |safety_island#113| ((state |safety_island_s|)) Bool (= (|safety_island#112| state) (|safety_island#51| state))) ; $eq$safety_island_end_to_end_properties.vh:74$296_Y
(define-fun |safety_island#114| ((state |safety_island_s|)) Bool (and (or  (|safety_island#111| state) false) (or  (|safety_island#113| state) false))) ; $logic_and$safety_island_end_to_end_properties.vh:74$297_Y
(define-fun |safety_island#115| ((state |safety_island_s|)) Bool (or  (|safety_island#58| state) false  (|safety_island#114| state) false)) ; \feeds
(define-fun |safety_island_n feeds| ((state |safety_island_s|)) Bool (|safety_island#115| state))
(declare-fun |safety_island#116| (|safety_island_s|) (_ BitVec 17)) ; \share_g
(define-fun |safety_island#117| ((state |safety_island_s|)) (_ BitVec 18) (bvsub (concat #b0 (concat (ite (|safety_island#15| state) #b1 #b0) #b0000000000000000)) (concat #b0 (|safety_island#116| state)))) ; \flow_g [17:0]
(define-fun |safety_island_n flow_g| ((state |safety_island_s|)) (_ BitVec 39) (concat ((_ extract 17 17) (|safety_island#117| state)) (concat ((_ extract 17 17) (|safety_island#117| state)) (concat ((_ extract 17 17) (|safety_island#117| state)) (concat ((_ extract 17 17) (|safety_island#117| state)) (concat ((_ extract 17 17) (|safety_island#117| state)) (concat ((_ extract 17 17) (|safety_island#117| state)) (concat ((_ extract 17 17) (|safety_island#117| state)) (concat ((_ extract 17 17) (|safety_island#117| state)) (concat ((_ extract 17 17) (|safety_island#117| state)) (concat ((_ extract 17 17) (|safety_island#117| state)) (concat ((_ extract 17 17) (|safety_island#117| state)) (concat ((_ extract 17 17) (|safety_island#117| state)) (concat ((_ extract 17 17) (|safety_island#117| state)) (concat ((_ extract 17 17) (|safety_island#117| state)) (concat ((_ extract 17 17) (|safety_island#117| state)) (concat ((_ extract 17 17) (|safety_island#117| state)) (concat ((_ extract 17 17) (|safety_island#117| state)) (concat ((_ extract 17 17) (|safety_island#117| state)) (concat ((_ extract 17 17) (|safety_island#117| state)) (concat ((_ extract 17 17) (|safety_island#117| state)) (concat ((_ extract 17 17) (|safety_island#117| state)) (|safety_island#117| state)))))))))))))))))))))))
(define-fun |safety_island_n focus_o| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#36| state)) #b1))
(define-fun |safety_island_n heard_i| ((state |safety_island_s|)) Bool (|safety_island#109| state))
(declare-fun |safety_island#118| (|safety_island_s|) (_ BitVec 1)) ; \link_q
(define-fun |safety_island#119| ((state |safety_island_s|)) Bool (= (|safety_island#112| state) (|safety_island#118| state))) ; $eq$safety_island.v:112$236_Y
(define-fun |safety_island#120| ((state |safety_island_s|)) Bool (and (or  (|safety_island#111| state) false) (or  (|safety_island#119| state) false))) ; $logic_and$safety_island.v:112$237_Y
(define-fun |safety_island#121| ((state |safety_island_s|)) Bool (or  (|safety_island#48| state) false  (|safety_island#120| state) false)) ; \output_gate.heartbeat_i
(define-fun |safety_island_n heartbeat| ((state |safety_island_s|)) Bool (|safety_island#121| state))
(declare-fun |safety_island#122| (|safety_island_s|) (_ BitVec 23)) ; \heartbeat_1_q
(define-fun |safety_island_n heartbeat_1_q| ((state |safety_island_s|)) (_ BitVec 23) (|safety_island#122| state))
(define-fun |safety_island_n heartbeat_is_clamped_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#38| state)) #b1))
(declare-fun |safety_island#123| (|safety_island_s|) (_ BitVec 32)) ; \heartbeat_ticks_i
(define-fun |safety_island_n heartbeat_ticks_i| ((state |safety_island_s|)) (_ BitVec 32) (|safety_island#123| state))
(declare-fun |safety_island#124| (|safety_island_s|) (_ BitVec 23)) ; \heartbeat_ticks_q
(define-fun |safety_island_n heartbeat_ticks_q| ((state |safety_island_s|)) (_ BitVec 23) (|safety_island#124| state))
(declare-fun |safety_island#125| (|safety_island_s|) (_ BitVec 1)) ; \hv_1_g
(define-fun |safety_island#126| ((state |safety_island_s|)) Bool (and (or  (= ((_ extract 1 1) (|safety_island#5| state)) #b1) false) (or  (= ((_ extract 0 0) (|safety_island#125| state)) #b1) false))) ; $logic_and$safety_island_end_to_end_properties.vh:154$395_Y
(define-fun |safety_island#127| ((state |safety_island_s|)) Bool (not (or  (= ((_ extract 0 0) (|safety_island#71| state)) #b1) false))) ; $logic_not$safety_island_end_to_end_properties.vh:155$399_Y
(define-fun |safety_island#128| ((state |safety_island_s|)) Bool (and (or  (|safety_island#126| state) false) (or  (|safety_island#127| state) false))) ; $logic_and$safety_island_end_to_end_properties.vh:155$400_Y
(define-fun |safety_island#129| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#128| state) #b1 #b0)) ; $procmux$1637_Y
(define-fun |safety_island#130| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#8| state) (|safety_island#129| state) #b0)) ; \heat_is_a_fault_EN
(define-fun |safety_island_n heat_is_a_fault_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#130| state)) #b1))
(define-fun |safety_island_n heat_is_its_pin_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#79| state)) #b1))
(define-fun |safety_island_n heat_lasts_a_clock_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#79| state)) #b1))
(define-fun |safety_island#131| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#71| state)) #b1) #b0 #b1)) ; $procmux$1686_Y
(define-fun |safety_island#132| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#8| state) (|safety_island#131| state) #b0)) ; \heat_pin_is_off_EN
(define-fun |safety_island_n heat_pin_is_off_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#132| state)) #b1))
(define-fun |safety_island_n hv_1_g| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#125| state)) #b1))
(define-fun |safety_island_n hv_alive_o| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#33| state)) #b1))
(define-fun |safety_island_n hv_enable_o| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#30| state)) #b1))
(declare-fun |safety_island#133| (|safety_island_s|) (_ BitVec 2)) ; \late_g
(define-fun |safety_island_n late_g| ((state |safety_island_s|)) (_ BitVec 2) (|safety_island#133| state))
(declare-fun |safety_island#134| (|safety_island_s|) (_ BitVec 16)) ; \least_1_g
(define-fun |safety_island_n least_1_g| ((state |safety_island_s|)) (_ BitVec 16) (|safety_island#134| state))
(declare-fun |safety_island#135| (|safety_island_s|) (_ BitVec 16)) ; \pulse_ticks_i
(define-fun |safety_island#136| ((state |safety_island_s|)) Bool (bvult (|safety_island#135| state) #b0000000001011101)) ; \least_pulse
(define-fun |safety_island_n least_pulse| ((state |safety_island_s|)) Bool (|safety_island#136| state))
(define-fun |safety_island#137| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#125| state)) #b1) #b0 #b1)) ; $procmux$1670_Y
(define-fun |safety_island#138| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#30| state)) #b1) (|safety_island#137| state) #b0)) ; $procmux$1673_Y
(define-fun |safety_island#139| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#8| state) (|safety_island#138| state) #b0)) ; \life_begins_EN
(define-fun |safety_island_n life_begins_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#139| state)) #b1))
(define-fun |safety_island_n life_goes_on_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#79| state)) #b1))
(define-fun |safety_island#140| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#125| state)) #b1) #b1 #b0)) ; $procmux$1662_Y
(define-fun |safety_island#141| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#30| state)) #b1) (|safety_island#140| state) #b0)) ; $procmux$1665_Y
(define-fun |safety_island#142| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#8| state) (|safety_island#141| state) #b0)) ; \life_has_its_rate_EN
(define-fun |safety_island_n life_has_its_rate_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#142| state)) #b1))
(declare-fun |safety_island#143| (|safety_island_s|) (_ BitVec 1)) ; \stage_limits.short_q
(declare-fun |safety_island#144| (|safety_island_s|) (_ BitVec 1)) ; \stage_limits.edges_q
(declare-fun |safety_island#145| (|safety_island_s|) (_ BitVec 1)) ; \stage_limits.total_edges_q
(declare-fun |safety_island#146| (|safety_island_s|) (_ BitVec 1)) ; \stage_limits.late_q
(declare-fun |safety_island#147| (|safety_island_s|) (_ BitVec 1)) ; \stage_limits.duty_q
(define-fun |safety_island_n limits| ((state |safety_island_s|)) (_ BitVec 5) (concat (|safety_island#147| state) (concat (|safety_island#146| state) (concat (|safety_island#145| state) (concat (|safety_island#144| state) (|safety_island#143| state))))))
(declare-fun |safety_island#148| (|safety_island_s|) (_ BitVec 1)) ; \rst_1_q
(define-fun |safety_island#149| ((state |safety_island_s|)) Bool (not (or  (= ((_ extract 0 0) (|safety_island#148| state)) #b1) false))) ; $logic_not$safety_island_properties.vh:40$467_Y
(define-fun |safety_island#150| ((state |safety_island_s|)) Bool (not (or  (= ((_ extract 0 0) (|safety_island#49| state)) #b1) false))) ; $logic_not$safety_island_properties.vh:44$486_Y
(define-fun |safety_island#151| ((state |safety_island_s|)) Bool (and (or  (|safety_island#149| state) false) (or  (|safety_island#150| state) false))) ; $logic_and$safety_island_properties.vh:44$487_Y
(define-fun |safety_island#152| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#151| state) #b1 #b0)) ; $procmux$1730_Y
(define-fun |safety_island#153| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#22| state)) #b1) (|safety_island#152| state) #b0)) ; \limits_of_edges_rest_EN
(define-fun |safety_island_n limits_of_edges_rest_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#153| state)) #b1))
(declare-fun |safety_island#154| (|safety_island_s|) (_ BitVec 1)) ; \off_1_q
(define-fun |safety_island#155| ((state |safety_island_s|)) Bool (not (or  (= ((_ extract 0 0) (|safety_island#154| state)) #b1) false))) ; $logic_not$safety_island_properties.vh:40$468_Y
(define-fun |safety_island#156| ((state |safety_island_s|)) Bool (and (or  (|safety_island#149| state) false) (or  (|safety_island#155| state) false))) ; $logic_and$safety_island_properties.vh:40$469_Y
(define-fun |safety_island#157| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#156| state) #b1 #b0)) ; $procmux$1734_Y
(define-fun |safety_island#158| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#22| state)) #b1) (|safety_island#157| state) #b0)) ; \limits_rest_EN
(define-fun |safety_island_n limits_rest_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#158| state)) #b1))
(declare-fun |safety_island#159| (|safety_island_s|) (_ BitVec 1)) ; \link_1_q
(define-fun |safety_island_n link_1_q| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#159| state)) #b1))
(define-fun |safety_island_n link_i| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#112| state)) #b1))
(define-fun |safety_island_n link_q| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#118| state)) #b1))
(define-fun |safety_island#160| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 1 1) (|safety_island#133| state)) #b1) #b1 #b0)) ; $procmux$1621_Y
(define-fun |safety_island#161| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#8| state) (|safety_island#160| state) #b0)) ; \long_emission_is_off_EN
(define-fun |safety_island_n long_emission_is_off_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#161| state)) #b1))
(declare-fun |safety_island#162| (|safety_island_s|) (_ BitVec 1)) ; \permit_3_g
(define-fun |safety_island#163| ((state |safety_island_s|)) Bool (not (or  (= ((_ extract 0 0) (|safety_island#162| state)) #b1) false))) ; $logic_not$safety_island_end_to_end_properties.vh:154$396_Y
(define-fun |safety_island#164| ((state |safety_island_s|)) Bool (and (or  (|safety_island#126| state) false) (or  (|safety_island#163| state) false))) ; $logic_and$safety_island_end_to_end_properties.vh:154$397_Y
(define-fun |safety_island#165| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#164| state) #b1 #b0)) ; $procmux$1641_Y
(define-fun |safety_island#166| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#8| state) (|safety_island#165| state) #b0)) ; \lost_permit_is_a_fault_EN
(define-fun |safety_island_n lost_permit_is_a_fault_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#166| state)) #b1))
(declare-fun |safety_island#167| (|safety_island_s|) (_ BitVec 1)) ; \mark
(define-fun |safety_island_n mark| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#167| state)) #b1))
(declare-fun |safety_island#168| (|safety_island_s|) (_ BitVec 32)) ; \mask_1_g
(define-fun |safety_island_n mask_1_g| ((state |safety_island_s|)) (_ BitVec 32) (|safety_island#168| state))
(define-fun |safety_island#169| ((state |safety_island_s|)) Bool (bvugt (|safety_island#84| state) #b00000000000101101110001101100000)) ; \most_duty
(define-fun |safety_island_n most_duty| ((state |safety_island_s|)) Bool (|safety_island#169| state))
(define-fun |safety_island#170| ((state |safety_island_s|)) Bool (bvugt (|safety_island#65| state) #b00000000000000000011001111000010)) ; \most_edges
(define-fun |safety_island_n most_edges| ((state |safety_island_s|)) Bool (|safety_island#170| state))
(define-fun |safety_island#171| ((state |safety_island_s|)) Bool (bvugt (|safety_island#97| state) #b00000000000000100000000010110010)) ; \most_emission
(define-fun |safety_island_n most_emission| ((state |safety_island_s|)) Bool (|safety_island#171| state))
(define-fun |safety_island#172| ((state |safety_island_s|)) Bool (bvugt (|safety_island#123| state) #b00000000010111110101111000010000)) ; \most_heartbeat
(define-fun |safety_island_n most_heartbeat| ((state |safety_island_s|)) Bool (|safety_island#172| state))
(define-fun |safety_island#173| ((state |safety_island_s|)) Bool (bvugt (|safety_island#82| state) #b00100110011001101)) ; \most_share
(define-fun |safety_island_n most_share| ((state |safety_island_s|)) Bool (|safety_island#173| state))
(declare-fun |safety_island#174| (|safety_island_s|) (_ BitVec 32)) ; \total_edges_i
(define-fun |safety_island#175| ((state |safety_island_s|)) Bool (bvugt (|safety_island#174| state) #b00000000000001011011100011011000)) ; \most_total
(define-fun |safety_island_n most_total| ((state |safety_island_s|)) Bool (|safety_island#175| state))
(define-fun |safety_island_n _witness_.anyinit_flatten_output_gate__procdff_2591| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#32| state)) #b1))
(declare-fun |safety_island#176| (|safety_island_s|) (_ BitVec 2)) ; \much_g
(define-fun |safety_island#177| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 1 1) (|safety_island#176| state)) #b1) #b1 #b0)) ; $procmux$1617_Y
(define-fun |safety_island#178| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#8| state) (|safety_island#177| state) #b0)) ; \much_duty_is_off_EN
(define-fun |safety_island_n much_duty_is_off_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#178| state)) #b1))
(define-fun |safety_island_n much_g| ((state |safety_island_s|)) (_ BitVec 2) (|safety_island#176| state))
(define-fun |safety_island#179| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#23| state) #b1 #b0)) ; \no_clock_is_off_EN
(define-fun |safety_island_n no_clock_is_off_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#179| state)) #b1))
(define-fun |safety_island#180| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#30| state)) #b1) #b0 #b1)) ; $procmux$1678_Y
(define-fun |safety_island#181| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#8| state) (|safety_island#180| state) #b0)) ; \no_life_when_off_EN
(define-fun |safety_island_n no_life_when_off_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#181| state)) #b1))
(define-fun |safety_island_n no_stage_no_move_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#38| state)) #b1))
(declare-fun |safety_island#182| (|safety_island_s|) (_ BitVec 64)) ; \now_i
(define-fun |safety_island_n now_i| ((state |safety_island_s|)) (_ BitVec 64) (|safety_island#182| state))
(define-fun |safety_island_n off_1_q| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#154| state)) #b1))
(declare-fun |safety_island#183| (|safety_island_s|) (_ BitVec 4)) ; \off_g
(define-fun |safety_island_n off_g| ((state |safety_island_s|)) (_ BitVec 4) (|safety_island#183| state))
(define-fun |safety_island#184| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 3 3) (|safety_island#183| state)) #b1) #b1 #b0)) ; $procmux$1629_Y
(define-fun |safety_island#185| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#8| state) (|safety_island#184| state) #b0)) ; \off_is_off_EN
(define-fun |safety_island_n off_is_off_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#185| state)) #b1))
(define-fun |safety_island_n off_o| ((state |safety_island_s|)) Bool (|safety_island#40| state))
(define-fun |safety_island#186| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#37| state) #b1 #b0)) ; $flatten\output_gate.$procmux$2154_Y
(define-fun |safety_island#187| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#8| state) (|safety_island#186| state) #b0)) ; \on_while_allowed_EN
(define-fun |safety_island_n on_while_allowed_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#187| state)) #b1))
(define-fun |safety_island_n on_without_fault_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#187| state)) #b1))
(define-fun |safety_island_n one| ((state |safety_island_s|)) (_ BitVec 5) (|safety_island#89| state))
(define-fun |safety_island#188| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#121| state) #b1 #b0)) ; $procmux$1724_Y
(define-fun |safety_island#189| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#22| state)) #b1) (|safety_island#188| state) #b0)) ; \one_link_feeds_EN
(define-fun |safety_island_n one_link_feeds_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#189| state)) #b1))
(define-fun |safety_island_n only_the_armer_feeds_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#187| state)) #b1))
(define-fun |safety_island_n only_what_may_move_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#79| state)) #b1))
(define-fun |safety_island_n other_link_arms_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#79| state)) #b1))
(define-fun |safety_island_n other_link_is_silent_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#79| state)) #b1))
(declare-fun |safety_island#190| (|safety_island_s|) (_ BitVec 1)) ; \output_gate.shut_1_q
(declare-fun |safety_island#191| (|safety_island_s|) (_ BitVec 16)) ; \output_gate.all_faults_1_q
(define-fun |safety_island#192| ((state |safety_island_s|)) Bool (not (or  (= ((_ extract 0 0) (|safety_island#191| state)) #b1) (= ((_ extract 1 1) (|safety_island#191| state)) #b1) (= ((_ extract 2 2) (|safety_island#191| state)) #b1) (= ((_ extract 3 3) (|safety_island#191| state)) #b1) (= ((_ extract 4 4) (|safety_island#191| state)) #b1) (= ((_ extract 5 5) (|safety_island#191| state)) #b1) (= ((_ extract 6 6) (|safety_island#191| state)) #b1) (= ((_ extract 7 7) (|safety_island#191| state)) #b1) (= ((_ extract 8 8) (|safety_island#191| state)) #b1) (= ((_ extract 9 9) (|safety_island#191| state)) #b1) (= ((_ extract 10 10) (|safety_island#191| state)) #b1) (= ((_ extract 11 11) (|safety_island#191| state)) #b1) (= ((_ extract 12 12) (|safety_island#191| state)) #b1) (= ((_ extract 13 13) (|safety_island#191| state)) #b1) (= ((_ extract 14 14) (|safety_island#191| state)) #b1) (= ((_ extract 15 15) (|safety_island#191| state)) #b1)))) ; $flatten\output_gate.$eq$output_gate_properties.vh:110$1063_Y
(define-fun |safety_island#193| ((state |safety_island_s|)) Bool (and (or  (= ((_ extract 0 0) (|safety_island#190| state)) #b1) false) (or  (|safety_island#192| state) false))) ; $flatten\output_gate.$logic_and$output_gate_properties.vh:110$1064_Y
(define-fun |safety_island#194| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#193| state) #b1 #b0)) ; $flatten\output_gate.$procmux$2197_Y
(declare-fun |safety_island#195| (|safety_island_s|) (_ BitVec 1)) ; \output_gate.rst_1_q
(define-fun |safety_island#196| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#195| state)) #b1) #b0 (|safety_island#194| state))) ; $flatten\output_gate.$procmux$2199_Y
(define-fun |safety_island#197| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#22| state)) #b1) (|safety_island#196| state) #b0)) ; \output_gate.a_fault_is_counted_EN
(define-fun |safety_island_n output_gate.a_fault_is_counted_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#197| state)) #b1))
(declare-fun |safety_island#198| (|safety_island_s|) (_ BitVec 32)) ; \output_gate.since_limit_q
(define-fun |safety_island#199| ((state |safety_island_s|)) Bool (bvult (|safety_island#198| state) #b00000000111011100110101100101000)) ; $flatten\output_gate.$lt$output_gate_properties.vh:121$1093_Y
(define-fun |safety_island#200| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#199| state) #b1 #b0)) ; $flatten\output_gate.$procmux$2149_Y
(define-fun |safety_island#201| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#22| state)) #b1) (|safety_island#200| state) #b0)) ; \output_gate.a_limit_rests_EN
(define-fun |safety_island_n output_gate.a_limit_rests_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#201| state)) #b1))
(declare-fun |safety_island#202| (|safety_island_s|) (_ BitVec 16)) ; \output_gate.age_1_q
(define-fun |safety_island_n output_gate.age_1_q| ((state |safety_island_s|)) (_ BitVec 16) (|safety_island#202| state))
(declare-fun |safety_island#203| (|safety_island_s|) (_ BitVec 16)) ; \output_gate.age_2_q
(define-fun |safety_island_n output_gate.age_2_q| ((state |safety_island_s|)) (_ BitVec 16) (|safety_island#203| state))
(declare-fun |safety_island#204| (|safety_island_s|) (_ BitVec 16)) ; \output_gate.age_3_q
(define-fun |safety_island_n output_gate.age_3_q| ((state |safety_island_s|)) (_ BitVec 16) (|safety_island#204| state))
(declare-fun |safety_island#205| (|safety_island_s|) (_ BitVec 16)) ; \output_gate.age_4_q
(define-fun |safety_island_n output_gate.age_4_q| ((state |safety_island_s|)) (_ BitVec 16) (|safety_island#205| state))
(declare-fun |safety_island#206| (|safety_island_s|) (_ BitVec 16)) ; \output_gate.age_q
(define-fun |safety_island_n output_gate.age_q| ((state |safety_island_s|)) (_ BitVec 16) (|safety_island#206| state))
(declare-fun |safety_island#207| (|safety_island_s|) (_ BitVec 11)) ; \output_gate.alive_left_q
(define-fun |safety_island_n output_gate.alive_left_q| ((state |safety_island_s|)) (_ BitVec 11) (|safety_island#207| state))
(define-fun |safety_island_n output_gate.alive_o| ((state |safety_island_s|)) Bool (|safety_island#18| state))
(define-fun |safety_island_n output_gate.all_faults_1_q| ((state |safety_island_s|)) (_ BitVec 16) (|safety_island#191| state))
(declare-fun |safety_island#208| (|safety_island_s|) (_ BitVec 1)) ; \output_gate.allowed_q
(define-fun |safety_island_n output_gate.allowed_q| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#208| state)) #b1))
(define-fun |safety_island_n output_gate.any| ((state |safety_island_s|)) Bool (|safety_island#37| state))
(define-fun |safety_island#209| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#23| state) #b0 #b1)) ; $flatten\output_gate.$procmux$2090_Y
(define-fun |safety_island#210| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#22| state)) #b1) (|safety_island#209| state) #b0)) ; \output_gate.any_is_known_EN
(define-fun |safety_island_n output_gate.any_is_known_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#210| state)) #b1))
(declare-fun |safety_island#211| (|safety_island_s|) (_ BitVec 1)) ; \output_gate.arm_1_q
(define-fun |safety_island_n output_gate.arm_1_q| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#211| state)) #b1))
(define-fun |safety_island_n output_gate.arm_i| ((state |safety_island_s|)) Bool (|safety_island#48| state))
(define-fun |safety_island#212| ((state |safety_island_s|)) Bool (and (or  (|safety_island#48| state) false) (or  (= ((_ extract 0 0) (|safety_island#22| state)) #b1) false))) ; $flatten\output_gate.$logic_and$output_gate_properties.vh:34$913_Y
(define-fun |safety_island#213| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#212| state) #b1 #b0)) ; \output_gate.arm_is_as_taken_EN
(define-fun |safety_island_n output_gate.arm_is_as_taken_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#213| state)) #b1))
(define-fun |safety_island_n output_gate.armed_o| ((state |safety_island_s|)) Bool (|safety_island#50| state))
(declare-fun |safety_island#214| (|safety_island_s|) (_ BitVec 5)) ; \output_gate.limits_1_q
(define-fun |safety_island#215| ((state |safety_island_s|)) Bool (distinct (|safety_island#214| state) #b00000)) ; $flatten\output_gate.$ne$output_gate_properties.vh:91$1034_Y
(define-fun |safety_island#216| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#215| state) #b1 #b0)) ; $flatten\output_gate.$procmux$2265_Y
(define-fun |safety_island#217| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#22| state)) #b1) (|safety_island#216| state) #b0)) ; \output_gate.beyond_is_off_EN
(define-fun |safety_island_n output_gate.beyond_is_off_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#217| state)) #b1))
(define-fun |safety_island_n output_gate.bit_ticks_i| ((state |safety_island_s|)) (_ BitVec 16) (|safety_island#63| state))
(define-fun |safety_island#218| ((state |safety_island_s|)) Bool (not (or  (= ((_ extract 1 1) (|safety_island#45| state)) #b1) false))) ; \output_gate.wrong [0]
(define-fun |safety_island#219| ((state |safety_island_s|)) Bool (not (or  (= ((_ extract 1 1) (|safety_island#47| state)) #b1) false))) ; \output_gate.wrong [2]
(declare-fun |safety_island#220| (|safety_island_s|) (_ BitVec 1)) ; \underrun_i
(define-fun |safety_island#221| ((state |safety_island_s|)) (_ BitVec 9) (bvand (concat (|safety_island#147| state) (concat (|safety_island#146| state) (concat (|safety_island#145| state) (concat (|safety_island#144| state) (concat (|safety_island#143| state) (concat (|safety_island#220| state) (concat (ite (|safety_island#219| state) #b1 #b0) (concat (|safety_island#17| state) (ite (|safety_island#218| state) #b1 #b0))))))))) (concat (|safety_island#20| state) (concat (|safety_island#20| state) (concat #b11 (concat (|safety_island#20| state) (concat (|safety_island#20| state) (concat (|safety_island#20| state) (concat (|safety_island#20| state) (|safety_island#20| state)))))))))) ; \output_gate.cause
(define-fun |safety_island_n output_gate.cause| ((state |safety_island_s|)) (_ BitVec 9) (|safety_island#221| state))
(define-fun |safety_island_n output_gate.channel_mask_i| ((state |safety_island_s|)) (_ BitVec 32) (|safety_island#67| state))
(define-fun |safety_island_n output_gate.channel_o| ((state |safety_island_s|)) (_ BitVec 32) (|safety_island#27| state))
(define-fun |safety_island_n output_gate.channel_q| ((state |safety_island_s|)) (_ BitVec 32) (|safety_island#27| state))
(declare-fun |safety_island#222| (|safety_island_s|) (_ BitVec 1)) ; \output_gate.clear_1_q
(define-fun |safety_island_n output_gate.clear_1_q| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#222| state)) #b1))
(define-fun |safety_island_n output_gate.clear_i| ((state |safety_island_s|)) Bool (|safety_island#68| state))
(define-fun |safety_island_n output_gate.clk_i| ((state |safety_island_s|)) Bool (|safety_island#69| state))
(define-fun |safety_island_n output_gate.clock_is_lost_in_reset_EN| ((state |safety_island_s|)) Bool true)
(define-fun |safety_island_n output_gate.clock_lost_i| ((state |safety_island_s|)) Bool (|safety_island#23| state))
(declare-fun |safety_island#223| (|safety_island_s|) (_ BitVec 1)) ; \output_gate.cool_1_q
(define-fun |safety_island_n output_gate.cool_1_q| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#223| state)) #b1))
(define-fun |safety_island#224| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#193| state) #b0 #b1)) ; $flatten\output_gate.$procmux$2189_Y
(define-fun |safety_island#225| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#195| state)) #b1) #b0 (|safety_island#224| state))) ; $flatten\output_gate.$procmux$2191_Y
(define-fun |safety_island#226| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#22| state)) #b1) (|safety_island#225| state) #b0)) ; \output_gate.counted_once_EN
(define-fun |safety_island_n output_gate.counted_once_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#226| state)) #b1))
(declare-fun |safety_island#227| (|safety_island_s|) (_ BitVec 1)) ; \output_gate.disarm_1_q
(define-fun |safety_island_n output_gate.disarm_1_q| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#227| state)) #b1))
(define-fun |safety_island_n output_gate.disarm_i| ((state |safety_island_s|)) Bool (|safety_island#75| state))
(define-fun |safety_island#228| ((state |safety_island_s|)) Bool (not (or  (= ((_ extract 0 0) (|safety_island#211| state)) #b1) false))) ; $flatten\output_gate.$logic_not$output_gate_properties.vh:113$1075_Y
(define-fun |safety_island#229| ((state |safety_island_s|)) Bool (and (or  (= ((_ extract 0 0) (|safety_island#227| state)) #b1) false) (or  (|safety_island#228| state) false))) ; $flatten\output_gate.$logic_and$output_gate_properties.vh:113$1076_Y
(define-fun |safety_island#230| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#229| state) #b1 #b0)) ; $flatten\output_gate.$procmux$2174_Y
(define-fun |safety_island#231| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#195| state)) #b1) #b0 (|safety_island#230| state))) ; $flatten\output_gate.$procmux$2176_Y
(define-fun |safety_island#232| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#22| state)) #b1) (|safety_island#231| state) #b0)) ; \output_gate.disarm_is_obeyed_EN
(define-fun |safety_island_n output_gate.disarm_is_obeyed_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#232| state)) #b1))
(declare-fun |safety_island#233| (|safety_island_s|) (_ BitVec 1)) ; \output_gate.disarmed_q
(define-fun |safety_island#234| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#233| state)) #b1) #b1 #b0)) ; $flatten\output_gate.$procmux$2159_Y
(define-fun |safety_island#235| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#22| state)) #b1) (|safety_island#234| state) #b0)) ; \output_gate.disarmed_for_good_EN
(define-fun |safety_island_n output_gate.disarmed_for_good_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#235| state)) #b1))
(define-fun |safety_island_n output_gate.disarmed_q| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#233| state)) #b1))
(declare-fun |safety_island#236| (|safety_island_s|) (_ BitVec 32)) ; \output_gate.drive_1_q
(define-fun |safety_island_n output_gate.drive_1_q| ((state |safety_island_s|)) (_ BitVec 32) (|safety_island#236| state))
(define-fun |safety_island_n output_gate.drive_i| ((state |safety_island_s|)) (_ BitVec 32) (|safety_island#77| state))
(define-fun |safety_island_n output_gate.edges| ((state |safety_island_s|)) (_ BitVec 5) (concat #b00 (concat (|safety_island#145| state) (concat (|safety_island#144| state) #b0))))
(declare-fun |safety_island#237| (|safety_island_s|) (_ BitVec 5)) ; \output_gate.edges_1_q
(define-fun |safety_island_n output_gate.edges_1_q| ((state |safety_island_s|)) (_ BitVec 5) (|safety_island#237| state))
(define-fun |safety_island#238| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#195| state)) #b1) #b0 #b1)) ; $flatten\output_gate.$procmux$2204_Y
(define-fun |safety_island#239| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#22| state)) #b1) (|safety_island#238| state) #b0)) ; \output_gate.edges_are_kept_EN
(define-fun |safety_island_n output_gate.edges_are_kept_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#239| state)) #b1))
(define-fun |safety_island#240| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#28| state) #b1 #b0)) ; $flatten\output_gate.$procmux$2010_Y
(define-fun |safety_island#241| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#23| state) #b0 (|safety_island#240| state))) ; $flatten\output_gate.$procmux$2012_Y
(define-fun |safety_island#242| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#22| state)) #b1) (|safety_island#241| state) #b0)) ; \output_gate.edges_once_settled_EN
(define-fun |safety_island_n output_gate.edges_once_settled_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#242| state)) #b1))
(define-fun |safety_island_n output_gate.emissions_o| ((state |safety_island_s|)) (_ BitVec 32) (|safety_island#101| state))
(define-fun |safety_island_n output_gate.emissions_q| ((state |safety_island_s|)) (_ BitVec 32) (|safety_island#101| state))
(define-fun |safety_island_n output_gate.ended_i| ((state |safety_island_s|)) Bool (|safety_island#102| state))
(define-fun |safety_island#243| ((state |safety_island_s|)) Bool (= (|safety_island#11| state) #b101)) ; \output_gate.settling
(define-fun |safety_island#244| ((state |safety_island_s|)) Bool (or  (|safety_island#12| state) false  (|safety_island#50| state) false)) ; $flatten\output_gate.$logic_or$output_gate.v:84$832_Y
(define-fun |safety_island#245| ((state |safety_island_s|)) Bool (= (|safety_island#11| state) #b011)) ; \stopping_o
(define-fun |safety_island#246| ((state |safety_island_s|)) Bool (or  (|safety_island#244| state) false  (|safety_island#245| state) false)) ; $flatten\output_gate.$logic_or$output_gate.v:84$834_Y
(define-fun |safety_island#247| ((state |safety_island_s|)) Bool (or  (|safety_island#246| state) false  (|safety_island#14| state) false)) ; \output_gate.moves
(define-fun |safety_island#248| ((state |safety_island_s|)) Bool (or  (|safety_island#243| state) false  (|safety_island#247| state) false)) ; \output_gate.on
(define-fun |safety_island#249| ((state |safety_island_s|)) Bool (or  (|safety_island#248| state) false  (|safety_island#40| state) false)) ; \output_gate.exists
(define-fun |safety_island_n output_gate.exists| ((state |safety_island_s|)) Bool (|safety_island#249| state))
(declare-fun |safety_island#250| (|safety_island_s|) (_ BitVec 1)) ; \output_gate.exists_1_q
(define-fun |safety_island_n output_gate.exists_1_q| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#250| state)) #b1))
(declare-fun |safety_island#251| (|safety_island_s|) (_ BitVec 32)) ; \output_gate.fault_count_1_q
(define-fun |safety_island_n output_gate.fault_count_1_q| ((state |safety_island_s|)) (_ BitVec 32) (|safety_island#251| state))
(define-fun |safety_island_n output_gate.fault_count_o| ((state |safety_island_s|)) (_ BitVec 32) (|safety_island#106| state))
(define-fun |safety_island_n output_gate.fault_count_q| ((state |safety_island_s|)) (_ BitVec 32) (|safety_island#106| state))
(define-fun |safety_island_n output_gate.fault_o| ((state |safety_island_s|)) (_ BitVec 16) (concat #b0000000 (|safety_island#73| state)))
(define-fun |safety_island_n output_gate.fault_q| ((state |safety_island_s|)) (_ BitVec 9) (|safety_island#73| state))
(define-fun |safety_island_n output_gate.fault_time_o| ((state |safety_island_s|)) (_ BitVec 64) (|safety_island#107| state))
(define-fun |safety_island_n output_gate.fault_time_q| ((state |safety_island_s|)) (_ BitVec 64) (|safety_island#107| state))
(define-fun |safety_island_n output_gate.faulted_o| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#42| state)) #b1))
(define-fun |safety_island_n output_gate.faulted_q| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#42| state)) #b1))
(declare-fun |safety_island#252| (|safety_island_s|) (_ BitVec 5)) ; \output_gate.faults_1_q
(define-fun |safety_island_n output_gate.faults_1_q| ((state |safety_island_s|)) (_ BitVec 5) (|safety_island#252| state))
(declare-fun |safety_island#253| (|safety_island_s|) (_ BitVec 1)) ; \output_gate.fed_q
(define-fun |safety_island_n output_gate.fed_q| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#253| state)) #b1))
(declare-fun |safety_island#254| (|safety_island_s|) (_ BitVec 32)) ; \output_gate.fed_ticks_q
(define-fun |safety_island_n output_gate.fed_ticks_q| ((state |safety_island_s|)) (_ BitVec 32) (|safety_island#254| state))
(declare-fun |safety_island#255| (|safety_island_s|) (_ BitVec 16)) ; \output_gate.focus_left_q
(define-fun |safety_island_n output_gate.focus_left_q| ((state |safety_island_s|)) (_ BitVec 16) (|safety_island#255| state))
(define-fun |safety_island_n output_gate.focus_o| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#36| state)) #b1))
(define-fun |safety_island_n output_gate.focus_q| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#36| state)) #b1))
(define-fun |safety_island_n output_gate.heartbeat_i| ((state |safety_island_s|)) Bool (|safety_island#121| state))
(define-fun |safety_island_n output_gate.heartbeat_ticks_i| ((state |safety_island_s|)) (_ BitVec 32) (concat #b000000000 (|safety_island#124| state)))
(define-fun |safety_island#256| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#223| state)) #b1) #b0 #b1)) ; $flatten\output_gate.$procmux$2235_Y
(declare-fun |safety_island#257| (|safety_island_s|) (_ BitVec 1)) ; \output_gate.hv_1_q
(define-fun |safety_island#258| ((state |safety_island_s|)) Bool (not (or  (= ((_ extract 0 0) (|safety_island#195| state)) #b1) false))) ; $flatten\output_gate.$logic_not$output_gate_properties.vh:122$1095_Y
(define-fun |safety_island#259| ((state |safety_island_s|)) Bool (and (or  (= ((_ extract 0 0) (|safety_island#257| state)) #b1) false) (or  (|safety_island#258| state) false))) ; $flatten\output_gate.$logic_and$output_gate_properties.vh:99$1046_Y
(define-fun |safety_island#260| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#259| state) (|safety_island#256| state) #b0)) ; $flatten\output_gate.$procmux$2237_Y
(define-fun |safety_island#261| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#22| state)) #b1) (|safety_island#260| state) #b0)) ; \output_gate.heat_is_kept_EN
(define-fun |safety_island_n output_gate.heat_is_kept_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#261| state)) #b1))
(define-fun |safety_island#262| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#22| state)) #b1) (|safety_island#256| state) #b0)) ; \output_gate.hot_is_off_EN
(define-fun |safety_island_n output_gate.hot_is_off_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#262| state)) #b1))
(define-fun |safety_island_n output_gate.hv_1_q| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#257| state)) #b1))
(define-fun |safety_island_n output_gate.hv_alive_o| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#33| state)) #b1))
(define-fun |safety_island_n output_gate.hv_alive_q| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#33| state)) #b1))
(define-fun |safety_island_n output_gate.hv_enable_o| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#30| state)) #b1))
(define-fun |safety_island_n output_gate.hv_enable_q| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#30| state)) #b1))
(define-fun |safety_island_n output_gate.limits_1_q| ((state |safety_island_s|)) (_ BitVec 5) (|safety_island#214| state))
(define-fun |safety_island#263| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#259| state) #b1 #b0)) ; $flatten\output_gate.$procmux$2223_Y
(define-fun |safety_island#264| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#22| state)) #b1) (|safety_island#263| state) #b0)) ; \output_gate.limits_are_kept_EN
(define-fun |safety_island_n output_gate.limits_are_kept_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#264| state)) #b1))
(define-fun |safety_island_n output_gate.limits_i| ((state |safety_island_s|)) (_ BitVec 5) (concat (|safety_island#147| state) (concat (|safety_island#146| state) (concat (|safety_island#145| state) (concat (|safety_island#144| state) (|safety_island#143| state))))))
(define-fun |safety_island_n output_gate.live_is_anything_on_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#210| state)) #b1))
(define-fun |safety_island_n output_gate.live_q| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#20| state)) #b1))
(declare-fun |safety_island#265| (|safety_island_s|) (_ BitVec 9)) ; \_witness_.anyseq_auto_setundef_cc_550_execute_3258
(define-fun |safety_island_n _witness_.anyseq_auto_setundef_cc_550_execute_3258| ((state |safety_island_s|)) (_ BitVec 9) (|safety_island#265| state))
(declare-fun |safety_island#266| (|safety_island_s|) (_ BitVec 15)) ; \_witness_.anyseq_auto_setundef_cc_550_execute_3256
(define-fun |safety_island_n _witness_.anyseq_auto_setundef_cc_550_execute_3256| ((state |safety_island_s|)) (_ BitVec 15) (|safety_island#266| state))
(declare-fun |safety_island#267| (|safety_island_s|) (_ BitVec 32)) ; \output_gate.mask_1_q
(define-fun |safety_island_n output_gate.mask_1_q| ((state |safety_island_s|)) (_ BitVec 32) (|safety_island#267| state))
(define-fun |safety_island_n output_gate.mask_is_kept_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#38| state)) #b1))
(define-fun |safety_island_n output_gate.moves| ((state |safety_island_s|)) Bool (|safety_island#247| state))
(declare-fun |safety_island#268| (|safety_island_s|) (_ BitVec 3)) ; \output_gate.moves_later_q
(define-fun |safety_island_n output_gate.moves_later_q| ((state |safety_island_s|)) (_ BitVec 3) (|safety_island#268| state))
(define-fun |safety_island#269| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#247| state) #b1 #b0)) ; $flatten\output_gate.$procmux$2042_Y
(define-fun |safety_island#270| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#23| state) #b0 (|safety_island#269| state))) ; $flatten\output_gate.$procmux$2044_Y
(define-fun |safety_island#271| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#22| state)) #b1) (|safety_island#270| state) #b0)) ; \output_gate.moves_once_settled_EN
(define-fun |safety_island_n output_gate.moves_once_settled_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#271| state)) #b1))
(define-fun |safety_island_n output_gate.no_channel_alone_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#38| state)) #b1))
(define-fun |safety_island_n output_gate.no_clock_is_off_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#179| state)) #b1))
(define-fun |safety_island_n output_gate.no_sign_of_life_alone_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#38| state)) #b1))
(define-fun |safety_island#272| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#250| state)) #b1) #b0 #b1)) ; $flatten\output_gate.$procmux$2255_Y
(define-fun |safety_island#273| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#22| state)) #b1) (|safety_island#272| state) #b0)) ; \output_gate.nonsense_is_off_EN
(define-fun |safety_island_n output_gate.nonsense_is_off_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#273| state)) #b1))
(declare-fun |safety_island#274| (|safety_island_s|) (_ BitVec 64)) ; \output_gate.now_1_q
(define-fun |safety_island_n output_gate.now_1_q| ((state |safety_island_s|)) (_ BitVec 64) (|safety_island#274| state))
(define-fun |safety_island_n output_gate.now_i| ((state |safety_island_s|)) (_ BitVec 64) (|safety_island#182| state))
(define-fun |safety_island_n output_gate.off_o| ((state |safety_island_s|)) Bool (|safety_island#40| state))
(define-fun |safety_island_n output_gate.on| ((state |safety_island_s|)) Bool (|safety_island#248| state))
(declare-fun |safety_island#275| (|safety_island_s|) (_ BitVec 3)) ; \output_gate.on_later_q
(define-fun |safety_island_n output_gate.on_later_q| ((state |safety_island_s|)) (_ BitVec 3) (|safety_island#275| state))
(define-fun |safety_island#276| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#22| state)) #b1) (|safety_island#186| state) #b0)) ; \output_gate.on_once_armed_EN
(define-fun |safety_island_n output_gate.on_once_armed_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#276| state)) #b1))
(define-fun |safety_island_n output_gate.on_while_fed_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#276| state)) #b1))
(define-fun |safety_island_n output_gate.on_without_fault_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#276| state)) #b1))
(define-fun |safety_island#277| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#190| state)) #b1) #b0 #b1)) ; $flatten\output_gate.$procmux$2181_Y
(define-fun |safety_island#278| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#195| state)) #b1) #b0 (|safety_island#277| state))) ; $flatten\output_gate.$procmux$2183_Y
(define-fun |safety_island#279| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#22| state)) #b1) (|safety_island#278| state) #b0)) ; \output_gate.only_a_cause_is_kept_EN
(define-fun |safety_island_n output_gate.only_a_cause_is_kept_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#279| state)) #b1))
(define-fun |safety_island#280| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#222| state)) #b1) #b0 #b1)) ; $flatten\output_gate.$procmux$2209_Y
(define-fun |safety_island#281| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#195| state)) #b1) #b0 (|safety_island#280| state))) ; $flatten\output_gate.$procmux$2211_Y
(define-fun |safety_island#282| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#22| state)) #b1) (|safety_island#281| state) #b0)) ; \output_gate.only_a_command_clears_EN
(define-fun |safety_island_n output_gate.only_a_command_clears_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#282| state)) #b1))
(define-fun |safety_island_n output_gate.only_what_is_played_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#38| state)) #b1))
(define-fun |safety_island#283| ((state |safety_island_s|)) Bool (not (or  (|safety_island#218| state) (= ((_ extract 0 0) (|safety_island#17| state)) #b1) (|safety_island#219| state) (= ((_ extract 0 0) (|safety_island#220| state)) #b1) (= ((_ extract 0 0) (|safety_island#143| state)) #b1) (= ((_ extract 0 0) (|safety_island#144| state)) #b1) (= ((_ extract 0 0) (|safety_island#145| state)) #b1) (= ((_ extract 0 0) (|safety_island#146| state)) #b1) (= ((_ extract 0 0) (|safety_island#147| state)) #b1)))) ; $flatten\output_gate.$eq$output_gate.v:95$845_Y
(define-fun |safety_island#284| ((state |safety_island_s|)) Bool (and (or  (|safety_island#249| state) false) (or  (|safety_island#283| state) false))) ; \output_gate.stays
(define-fun |safety_island#285| ((state |safety_island_s|)) Bool (and (or  (= ((_ extract 2 2) (|safety_island#275| state)) #b1) false) (or  (|safety_island#284| state) false))) ; \output_gate.open
(define-fun |safety_island_n output_gate.open| ((state |safety_island_s|)) Bool (|safety_island#285| state))
(declare-fun |safety_island#286| (|safety_island_s|) (_ BitVec 1)) ; \output_gate.permit_1_q
(define-fun |safety_island_n output_gate.permit_1_q| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#286| state)) #b1))
(declare-fun |safety_island#287| (|safety_island_s|) Bool) ; \ramp_done_i
(define-fun |safety_island_n output_gate.ramp_done_i| ((state |safety_island_s|)) Bool (|safety_island#287| state))
(define-fun |safety_island_n output_gate.ramp_down_o| ((state |safety_island_s|)) Bool (|safety_island#14| state))
(define-fun |safety_island_n output_gate.ramp_up_o| ((state |safety_island_s|)) Bool (|safety_island#12| state))
(define-fun |safety_island#288| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#195| state)) #b1) #b1 #b0)) ; $flatten\output_gate.$procmux$2285_Y
(define-fun |safety_island#289| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#22| state)) #b1) (|safety_island#288| state) #b0)) ; \output_gate.reset_is_off_EN
(define-fun |safety_island_n output_gate.reset_is_off_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#289| state)) #b1))
(define-fun |safety_island_n output_gate.rest_has_its_time_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#210| state)) #b1))
(declare-fun |safety_island#290| (|safety_island_s|) (_ BitVec 1)) ; \output_gate.resting_q
(define-fun |safety_island#291| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#290| state)) #b1) #b1 #b0)) ; $flatten\output_gate.$procmux$2110_Y
(define-fun |safety_island#292| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#23| state) #b0 (|safety_island#291| state))) ; $flatten\output_gate.$procmux$2112_Y
(define-fun |safety_island#293| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#22| state)) #b1) (|safety_island#292| state) #b0)) ; \output_gate.rest_is_counted_EN
(define-fun |safety_island_n output_gate.rest_is_counted_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#293| state)) #b1))
(declare-fun |safety_island#294| (|safety_island_s|) (_ BitVec 1)) ; \output_gate.resting_1_q
(define-fun |safety_island#295| ((state |safety_island_s|)) Bool (and (or  (= ((_ extract 0 0) (|safety_island#294| state)) #b1) false) (or  (|safety_island#258| state) false))) ; $flatten\output_gate.$logic_and$output_gate_properties.vh:122$1096_Y
(define-fun |safety_island#296| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#295| state) #b1 #b0)) ; $flatten\output_gate.$procmux$2144_Y
(define-fun |safety_island#297| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#22| state)) #b1) (|safety_island#296| state) #b0)) ; \output_gate.rest_is_kept_EN
(define-fun |safety_island_n output_gate.rest_is_kept_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#297| state)) #b1))
(declare-fun |safety_island#298| (|safety_island_s|) (_ BitVec 32)) ; \output_gate.rest_left_q
(define-fun |safety_island_n output_gate.rest_left_q| ((state |safety_island_s|)) (_ BitVec 32) (|safety_island#298| state))
(define-fun |safety_island_n output_gate.resting_1_q| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#294| state)) #b1))
(define-fun |safety_island_n output_gate.resting_q| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#290| state)) #b1))
(define-fun |safety_island#299| ((state |safety_island_s|)) (_ BitVec 9) (bvand (concat ((_ extract 8 4) (|safety_island#73| state)) #b0000) (concat (|safety_island#290| state) (concat (|safety_island#290| state) (concat (|safety_island#290| state) (concat (|safety_island#290| state) (concat (|safety_island#290| state) (concat (|safety_island#290| state) (concat (|safety_island#290| state) (concat (|safety_island#290| state) (|safety_island#290| state))))))))))) ; \output_gate.rests
(define-fun |safety_island_n output_gate.rests| ((state |safety_island_s|)) (_ BitVec 9) (|safety_island#299| state))
(define-fun |safety_island_n output_gate.rst_1_q| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#195| state)) #b1))
(define-fun |safety_island_n output_gate.rst_i| ((state |safety_island_s|)) Bool (|safety_island#6| state))
(define-fun |safety_island_n output_gate.run_permit_i| ((state |safety_island_s|)) Bool (= ((_ extract 1 1) (|safety_island#45| state)) #b1))
(declare-fun |safety_island#300| (|safety_island_s|) (_ BitVec 16)) ; \output_gate.settle_left_q
(define-fun |safety_island_n output_gate.settle_left_q| ((state |safety_island_s|)) (_ BitVec 16) (|safety_island#300| state))
(declare-fun |safety_island#301| (|safety_island_s|) Bool) ; \settled_i
(define-fun |safety_island_n output_gate.settled_i| ((state |safety_island_s|)) Bool (|safety_island#301| state))
(define-fun |safety_island_n output_gate.settling| ((state |safety_island_s|)) Bool (|safety_island#243| state))
(define-fun |safety_island#302| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#243| state) #b1 #b0)) ; $flatten\output_gate.$procmux$2050_Y
(define-fun |safety_island#303| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#23| state) #b0 (|safety_island#302| state))) ; $flatten\output_gate.$procmux$2052_Y
(define-fun |safety_island#304| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#22| state)) #b1) (|safety_island#303| state) #b0)) ; \output_gate.settling_is_counted_EN
(define-fun |safety_island_n output_gate.settling_is_counted_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#304| state)) #b1))
(define-fun |safety_island_n output_gate.settling_o| ((state |safety_island_s|)) Bool (|safety_island#243| state))
(define-fun |safety_island#305| ((state |safety_island_s|)) Bool (distinct (|safety_island#221| state) #b000000000)) ; \output_gate.shut
(define-fun |safety_island_n output_gate.shut| ((state |safety_island_s|)) Bool (|safety_island#305| state))
(define-fun |safety_island_n output_gate.shut_1_q| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#190| state)) #b1))
(define-fun |safety_island_n output_gate.shut_o| ((state |safety_island_s|)) Bool (|safety_island#305| state))
(define-fun |safety_island#306| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#17| state)) #b1) #b0 #b1)) ; $flatten\output_gate.$procmux$2066_Y
(define-fun |safety_island#307| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#23| state) #b0 (|safety_island#306| state))) ; $flatten\output_gate.$procmux$2068_Y
(define-fun |safety_island#308| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#22| state)) #b1) (|safety_island#307| state) #b0)) ; \output_gate.silence_is_counted_EN
(define-fun |safety_island_n output_gate.silence_is_counted_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#308| state)) #b1))
(declare-fun |safety_island#309| (|safety_island_s|) (_ BitVec 1)) ; \output_gate.silent_1_q
(define-fun |safety_island#310| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#309| state)) #b1) #b1 #b0)) ; $flatten\output_gate.$procmux$2228_Y
(define-fun |safety_island#311| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#259| state) (|safety_island#310| state) #b0)) ; $flatten\output_gate.$procmux$2230_Y
(define-fun |safety_island#312| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#22| state)) #b1) (|safety_island#311| state) #b0)) ; \output_gate.silence_is_kept_EN
(define-fun |safety_island_n output_gate.silence_is_kept_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#312| state)) #b1))
(declare-fun |safety_island#313| (|safety_island_s|) (_ BitVec 32)) ; \output_gate.silence_q
(define-fun |safety_island_n output_gate.silence_q| ((state |safety_island_s|)) (_ BitVec 32) (|safety_island#313| state))
(define-fun |safety_island_n output_gate.silent_1_q| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#309| state)) #b1))
(define-fun |safety_island_n output_gate.silent_in_time_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#308| state)) #b1))
(define-fun |safety_island#314| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#22| state)) #b1) (|safety_island#310| state) #b0)) ; \output_gate.silent_is_off_EN
(define-fun |safety_island_n output_gate.silent_is_off_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#314| state)) #b1))
(define-fun |safety_island_n output_gate.silent_q| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#17| state)) #b1))
(define-fun |safety_island_n output_gate.since_limit_q| ((state |safety_island_s|)) (_ BitVec 32) (|safety_island#198| state))
(define-fun |safety_island_n output_gate.started_q| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#22| state)) #b1))
(define-fun |safety_island_n output_gate.state_q| ((state |safety_island_s|)) (_ BitVec 3) (|safety_island#11| state))
(define-fun |safety_island_n output_gate.stays| ((state |safety_island_s|)) Bool (|safety_island#284| state))
(define-fun |safety_island#315| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#286| state)) #b1) #b0 #b1)) ; $flatten\output_gate.$procmux$2242_Y
(define-fun |safety_island#316| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#259| state) (|safety_island#315| state) #b0)) ; $flatten\output_gate.$procmux$2244_Y
(define-fun |safety_island#317| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#22| state)) #b1) (|safety_island#316| state) #b0)) ; \output_gate.stop_is_kept_EN
(define-fun |safety_island_n output_gate.stop_is_kept_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#317| state)) #b1))
(define-fun |safety_island#318| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#22| state)) #b1) (|safety_island#315| state) #b0)) ; \output_gate.stopped_is_off_EN
(define-fun |safety_island_n output_gate.stopped_is_off_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#318| state)) #b1))
(define-fun |safety_island_n output_gate.stopping_o| ((state |safety_island_s|)) Bool (|safety_island#245| state))
(define-fun |safety_island_n output_gate.supply_has_settled_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#38| state)) #b1))
(define-fun |safety_island_n output_gate.temperature_good_i| ((state |safety_island_s|)) Bool (= ((_ extract 1 1) (|safety_island#47| state)) #b1))
(declare-fun |safety_island#319| (|safety_island_s|) (_ BitVec 1)) ; \output_gate.underrun_1_q
(define-fun |safety_island_n output_gate.underrun_1_q| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#319| state)) #b1))
(define-fun |safety_island_n output_gate.underrun_i| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#220| state)) #b1))
(define-fun |safety_island#320| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#319| state)) #b1) #b1 #b0)) ; $flatten\output_gate.$procmux$2216_Y
(define-fun |safety_island#321| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#259| state) (|safety_island#320| state) #b0)) ; $flatten\output_gate.$procmux$2218_Y
(define-fun |safety_island#322| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#22| state)) #b1) (|safety_island#321| state) #b0)) ; \output_gate.underrun_is_kept_EN
(define-fun |safety_island_n output_gate.underrun_is_kept_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#322| state)) #b1))
(define-fun |safety_island#323| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#22| state)) #b1) (|safety_island#320| state) #b0)) ; \output_gate.underrun_is_off_EN
(define-fun |safety_island_n output_gate.underrun_is_off_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#323| state)) #b1))
(declare-fun |safety_island#324| (|safety_island_s|) (_ BitVec 32)) ; \output_gate.underruns_q
(define-fun |safety_island_n output_gate.underruns_o| ((state |safety_island_s|)) (_ BitVec 32) (|safety_island#324| state))
(define-fun |safety_island_n output_gate.underruns_q| ((state |safety_island_s|)) (_ BitVec 32) (|safety_island#324| state))
(declare-fun |safety_island#325| (|safety_island_s|) (_ BitVec 32)) ; \output_gate.unfed_q
(define-fun |safety_island_n output_gate.unfed_q| ((state |safety_island_s|)) (_ BitVec 32) (|safety_island#325| state))
(declare-fun |safety_island#326| (|safety_island_s|) (_ BitVec 16)) ; \output_gate.up_q
(define-fun |safety_island_n output_gate.up_q| ((state |safety_island_s|)) (_ BitVec 16) (|safety_island#326| state))
(define-fun |safety_island_n output_gate.wrong| ((state |safety_island_s|)) (_ BitVec 9) (concat (|safety_island#147| state) (concat (|safety_island#146| state) (concat (|safety_island#145| state) (concat (|safety_island#144| state) (concat (|safety_island#143| state) (concat (|safety_island#220| state) (concat (ite (|safety_island#219| state) #b1 #b0) (concat (|safety_island#17| state) (ite (|safety_island#218| state) #b1 #b0))))))))))
(declare-fun |safety_island#327| (|safety_island_s|) (_ BitVec 39)) ; \owed_g
(define-fun |safety_island#328| ((state |safety_island_s|)) (_ BitVec 39) (bvadd (|safety_island#327| state) (concat ((_ extract 17 17) (|safety_island#117| state)) (concat ((_ extract 17 17) (|safety_island#117| state)) (concat ((_ extract 17 17) (|safety_island#117| state)) (concat ((_ extract 17 17) (|safety_island#117| state)) (concat ((_ extract 17 17) (|safety_island#117| state)) (concat ((_ extract 17 17) (|safety_island#117| state)) (concat ((_ extract 17 17) (|safety_island#117| state)) (concat ((_ extract 17 17) (|safety_island#117| state)) (concat ((_ extract 17 17) (|safety_island#117| state)) (concat ((_ extract 17 17) (|safety_island#117| state)) (concat ((_ extract 17 17) (|safety_island#117| state)) (concat ((_ extract 17 17) (|safety_island#117| state)) (concat ((_ extract 17 17) (|safety_island#117| state)) (concat ((_ extract 17 17) (|safety_island#117| state)) (concat ((_ extract 17 17) (|safety_island#117| state)) (concat ((_ extract 17 17) (|safety_island#117| state)) (concat ((_ extract 17 17) (|safety_island#117| state)) (concat ((_ extract 17 17) (|safety_island#117| state)) (concat ((_ extract 17 17) (|safety_island#117| state)) (concat ((_ extract 17 17) (|safety_island#117| state)) (concat ((_ extract 17 17) (|safety_island#117| state)) (|safety_island#117| state)))))))))))))))))))))))) ; \owed
(define-fun |safety_island_n owed| ((state |safety_island_s|)) (_ BitVec 39) (|safety_island#328| state))
(define-fun |safety_island_n owed_g| ((state |safety_island_s|)) (_ BitVec 39) (|safety_island#327| state))
(declare-fun |safety_island#329| (|safety_island_s|) (_ BitVec 32)) ; \patience_g
(define-fun |safety_island_n patience_g| ((state |safety_island_s|)) (_ BitVec 32) (|safety_island#329| state))
(declare-fun |safety_island#330| (|safety_island_s|) (_ BitVec 1)) ; \permit_1_g
(define-fun |safety_island_n permit_1_g| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#330| state)) #b1))
(define-fun |safety_island_n permit_2_g| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#55| state)) #b1))
(define-fun |safety_island_n permit_3_g| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#162| state)) #b1))
(define-fun |safety_island_n permit_is_its_pin_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#79| state)) #b1))
(define-fun |safety_island_n permit_is_lost_for_a_clock_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#79| state)) #b1))
(define-fun |safety_island#331| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#162| state)) #b1) #b0 #b1)) ; $procmux$1690_Y
(define-fun |safety_island#332| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#8| state) (|safety_island#331| state) #b0)) ; \permit_pin_is_off_EN
(define-fun |safety_island_n permit_pin_is_off_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#332| state)) #b1))
(define-fun |safety_island_n permits_are_linked_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#52| state)) #b1))
(define-fun |safety_island_n playing_i| ((state |safety_island_s|)) Bool (|safety_island#10| state))
(declare-fun |safety_island#333| (|safety_island_s|) (_ BitVec 16)) ; \pulse_1_q
(define-fun |safety_island_n pulse_1_q| ((state |safety_island_s|)) (_ BitVec 16) (|safety_island#333| state))
(define-fun |safety_island_n pulse_is_clamped_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#38| state)) #b1))
(define-fun |safety_island_n pulse_is_short_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#79| state)) #b1))
(define-fun |safety_island#334| ((state |safety_island_s|)) (_ BitVec 16) (ite (|safety_island#136| state) #b0000000001011101 (|safety_island#135| state))) ; \pulse_least
(define-fun |safety_island_n pulse_least| ((state |safety_island_s|)) (_ BitVec 16) (|safety_island#334| state))
(declare-fun |safety_island#335| (|safety_island_s|) (_ BitVec 16)) ; \pulse_least_g
(define-fun |safety_island_n pulse_least_g| ((state |safety_island_s|)) (_ BitVec 16) (|safety_island#335| state))
(define-fun |safety_island_n pulse_ticks_i| ((state |safety_island_s|)) (_ BitVec 16) (|safety_island#135| state))
(declare-fun |safety_island#336| (|safety_island_s|) (_ BitVec 16)) ; \pulse_ticks_q
(define-fun |safety_island_n pulse_ticks_q| ((state |safety_island_s|)) (_ BitVec 16) (|safety_island#336| state))
(define-fun |safety_island_n pulses_are_linked_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#52| state)) #b1))
(declare-fun |safety_island#337| (|safety_island_s|) (_ BitVec 32)) ; \quiet_g
(define-fun |safety_island_n quiet_g| ((state |safety_island_s|)) (_ BitVec 32) (|safety_island#337| state))
(declare-fun |safety_island#338| (|safety_island_s|) (_ BitVec 32)) ; \quiet_most_g
(define-fun |safety_island_n quiet_most_g| ((state |safety_island_s|)) (_ BitVec 32) (|safety_island#338| state))
(define-fun |safety_island_n ramp_done_i| ((state |safety_island_s|)) Bool (|safety_island#287| state))
(define-fun |safety_island_n ramp_down_o| ((state |safety_island_s|)) Bool (|safety_island#14| state))
(define-fun |safety_island_n ramp_up_o| ((state |safety_island_s|)) Bool (|safety_island#12| state))
(declare-fun |safety_island#339| (|safety_island_s|) (_ BitVec 1)) ; \rst_1_g
(define-fun |safety_island#340| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#339| state)) #b1) #b1 #b0)) ; \reset_is_off_EN
(define-fun |safety_island_n reset_is_off_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#340| state)) #b1))
(define-fun |safety_island_n rst_1_g| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#339| state)) #b1))
(define-fun |safety_island_n rst_1_q| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#148| state)) #b1))
(define-fun |safety_island_n rst_i| ((state |safety_island_s|)) Bool (|safety_island#6| state))
(define-fun |safety_island_n run_g| ((state |safety_island_s|)) (_ BitVec 5) (|safety_island#5| state))
(define-fun |safety_island_n run_permit| ((state |safety_island_s|)) Bool (= ((_ extract 1 1) (|safety_island#45| state)) #b1))
(declare-fun |safety_island#341| (|safety_island_s|) Bool) ; \run_permit_i
(define-fun |safety_island_n run_permit_i| ((state |safety_island_s|)) Bool (|safety_island#341| state))
(define-fun |safety_island_n run_permit_o| ((state |safety_island_s|)) Bool (= ((_ extract 1 1) (|safety_island#45| state)) #b1))
(define-fun |safety_island_n run_permit_q| ((state |safety_island_s|)) (_ BitVec 2) (|safety_island#45| state))
(define-fun |safety_island_n second_fault_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#79| state)) #b1))
(define-fun |safety_island_n settled_i| ((state |safety_island_s|)) Bool (|safety_island#301| state))
(define-fun |safety_island_n settling_o| ((state |safety_island_s|)) Bool (|safety_island#243| state))
(declare-fun |safety_island#342| (|safety_island_s|) (_ BitVec 17)) ; \share_1_q
(define-fun |safety_island_n share_1_q| ((state |safety_island_s|)) (_ BitVec 17) (|safety_island#342| state))
(define-fun |safety_island_n share_g| ((state |safety_island_s|)) (_ BitVec 17) (|safety_island#116| state))
(declare-fun |safety_island#343| (|safety_island_s|) (_ BitVec 3)) ; \short_g
(define-fun |safety_island_n short_g| ((state |safety_island_s|)) (_ BitVec 3) (|safety_island#343| state))
(define-fun |safety_island#344| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 2 2) (|safety_island#343| state)) #b1) #b1 #b0)) ; $procmux$1625_Y
(define-fun |safety_island#345| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#8| state) (|safety_island#344| state) #b0)) ; \short_pulse_is_off_EN
(define-fun |safety_island_n short_pulse_is_off_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#345| state)) #b1))
(define-fun |safety_island_n shut_o| ((state |safety_island_s|)) Bool (|safety_island#305| state))
(define-fun |safety_island#346| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#253| state)) #b1) #b1 #b0)) ; $procmux$1810_Y
(define-fun |safety_island#347| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#25| state) (|safety_island#346| state) #b0)) ; \silence_is_linked_EN
(define-fun |safety_island_n silence_is_linked_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#347| state)) #b1))
(declare-fun |safety_island#348| (|safety_island_s|) (_ BitVec 18)) ; \since_1_g
(define-fun |safety_island_n since_1_g| ((state |safety_island_s|)) (_ BitVec 18) (|safety_island#348| state))
(declare-fun |safety_island#349| (|safety_island_s|) (_ BitVec 18)) ; \since_g
(define-fun |safety_island_n since_g| ((state |safety_island_s|)) (_ BitVec 18) (|safety_island#349| state))
(declare-fun |safety_island#350| (|safety_island_s|) (_ BitVec 16)) ; \stage_limits.since_q
(define-fun |safety_island_n since_own| ((state |safety_island_s|)) (_ BitVec 16) (|safety_island#350| state))
(define-fun |safety_island_n since_reset| ((state |safety_island_s|)) Bool (|safety_island#8| state))
(define-fun |safety_island_n soon_is_linked_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#52| state)) #b1))
(declare-fun |safety_island#351| (|safety_island_s|) (_ BitVec 19)) ; \sounds_g
(define-fun |safety_island_n sounds_g| ((state |safety_island_s|)) (_ BitVec 19) (|safety_island#351| state))
(declare-fun |safety_island#352| (|safety_island_s|) (_ BitVec 15)) ; \stage_limits.account_q
(declare-fun |safety_island#353| (|safety_island_s|) (_ BitVec 1)) ; \stage_limits.fetched_first_q
(define-fun |safety_island#354| ((state |safety_island_s|)) (_ BitVec 15) (ite (= ((_ extract 0 0) (|safety_island#353| state)) #b1) #b000000000000000 (|safety_island#352| state))) ; \stage_limits.account
(define-fun |safety_island_n stage_limits.account| ((state |safety_island_s|)) (_ BitVec 15) (|safety_island#354| state))
(define-fun |safety_island_n stage_limits.account_q| ((state |safety_island_s|)) (_ BitVec 15) (|safety_island#352| state))
(define-fun |safety_island_n stage_limits.active_i| ((state |safety_island_s|)) Bool (|safety_island#15| state))
(declare-fun |safety_island#355| (|safety_island_s|) (_ BitVec 18)) ; \stage_limits.age_q
(declare-fun |safety_island#356| (|safety_island_s|) (_ BitVec 1)) ; \stage_limits.begins_q
(define-fun |safety_island#357| ((state |safety_island_s|)) (_ BitVec 18) (ite (= ((_ extract 0 0) (|safety_island#356| state)) #b1) #b000000000000000000 (|safety_island#355| state))) ; \stage_limits.age
(define-fun |safety_island_n stage_limits.age| ((state |safety_island_s|)) (_ BitVec 18) (|safety_island#357| state))
(define-fun |safety_island_n stage_limits.age_q| ((state |safety_island_s|)) (_ BitVec 18) (|safety_island#355| state))
(declare-fun |safety_island#358| (|safety_island_s|) (_ BitVec 21)) ; \stage_limits.all_q
(declare-fun |safety_island#359| (|safety_island_s|) (_ BitVec 6)) ; \stage_limits.moves_q
(define-fun |safety_island#360| ((state |safety_island_s|)) (_ BitVec 21) (bvadd (|safety_island#358| state) (concat #b000000000000000 (|safety_island#359| state)))) ; \stage_limits.all
(define-fun |safety_island_n stage_limits.all| ((state |safety_island_s|)) (_ BitVec 21) (|safety_island#360| state))
(declare-fun |safety_island#361| (|safety_island_s|) (_ BitVec 21)) ; \stage_limits.all_base_q
(define-fun |safety_island_n stage_limits.all_base_q| ((state |safety_island_s|)) (_ BitVec 21) (|safety_island#361| state))
(declare-fun |safety_island#362| (|safety_island_s|) (_ BitVec 21)) ; \stage_limits.all_limit_q
(define-fun |safety_island#363| ((state |safety_island_s|)) (_ BitVec 21) (bvsub (|safety_island#362| state) (|safety_island#360| state))) ; \stage_limits.all_left
(define-fun |safety_island_n stage_limits.all_left| ((state |safety_island_s|)) (_ BitVec 21) (|safety_island#363| state))
(define-fun |safety_island_n stage_limits.all_limit_q| ((state |safety_island_s|)) (_ BitVec 21) (|safety_island#362| state))
(define-fun |safety_island_n stage_limits.all_q| ((state |safety_island_s|)) (_ BitVec 21) (|safety_island#358| state))
(define-fun |safety_island_n stage_limits.awake| ((state |safety_island_s|)) Bool true)
(declare-fun |safety_island#364| (|safety_island_s|) (_ BitVec 15)) ; \stage_limits.base_q
(define-fun |safety_island_n stage_limits.base_q| ((state |safety_island_s|)) (_ BitVec 15) (|safety_island#364| state))
(define-fun |safety_island_n stage_limits.begins_q| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#356| state)) #b1))
(declare-fun |safety_island#365| (|safety_island_s|) (_ BitVec 1)) ; \stage_limits.begun_q
(define-fun |safety_island_n stage_limits.begun_q| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#365| state)) #b1))
(define-fun |safety_island_n stage_limits.cause_o| ((state |safety_island_s|)) (_ BitVec 5) (concat (|safety_island#147| state) (concat (|safety_island#146| state) (concat (|safety_island#145| state) (concat (|safety_island#144| state) (|safety_island#143| state))))))
(declare-fun |safety_island#366| (|safety_island_s|) (_ BitVec 32)) ; \stage_limits.pins_q
(define-fun |safety_island#367| ((state |safety_island_s|)) (_ BitVec 32) (bvxor (|safety_island#27| state) (|safety_island#366| state))) ; \stage_limits.change
(define-fun |safety_island_n stage_limits.change| ((state |safety_island_s|)) (_ BitVec 32) (|safety_island#367| state))
(declare-fun |safety_island#368| (|safety_island_s|) (_ BitVec 32)) ; \stage_limits.change_q
(define-fun |safety_island_n stage_limits.change_q| ((state |safety_island_s|)) (_ BitVec 32) (|safety_island#368| state))
(define-fun |safety_island_n stage_limits.channel_edges_i| ((state |safety_island_s|)) (_ BitVec 14) (|safety_island#66| state))
(define-fun |safety_island_n stage_limits.channel_i| ((state |safety_island_s|)) (_ BitVec 32) (|safety_island#27| state))
(define-fun |safety_island_n stage_limits.channels_o| ((state |safety_island_s|)) (_ BitVec 32) (|safety_island#72| state))
(define-fun |safety_island_n stage_limits.channels_q| ((state |safety_island_s|)) (_ BitVec 32) (|safety_island#72| state))
(define-fun |safety_island_n stage_limits.clear_i| ((state |safety_island_s|)) Bool (|safety_island#68| state))
(define-fun |safety_island_n stage_limits.clk_i| ((state |safety_island_s|)) Bool (|safety_island#69| state))
(declare-fun |safety_island#369| (|safety_island_s|) (_ BitVec 15)) ; \stage_limits.made_q
(define-fun |safety_island#370| ((state |safety_island_s|)) (_ BitVec 15) (bvsub (|safety_island#369| state) (|safety_island#364| state))) ; \stage_limits.counts
(define-fun |safety_island_n stage_limits.counts| ((state |safety_island_s|)) (_ BitVec 15) (|safety_island#370| state))
(define-fun |safety_island#371| ((state |safety_island_s|)) Bool (distinct ((_ extract 15 0) (|safety_island#80| state)) #b0000000000000000)) ; \stage_limits.part_tick
(define-fun |safety_island#372| ((state |safety_island_s|)) (_ BitVec 24) (bvsub (concat #b00 (concat (|safety_island#85| state) #b0)) (concat #b0 (concat ((_ extract 37 16) (|safety_island#80| state)) (ite (|safety_island#371| state) #b1 #b0))))) ; \stage_limits.duty_left
(define-fun |safety_island_n stage_limits.duty_left| ((state |safety_island_s|)) (_ BitVec 24) (|safety_island#372| state))
(define-fun |safety_island_n stage_limits.duty_level_o| ((state |safety_island_s|)) (_ BitVec 32) (concat #b0000000000 ((_ extract 37 16) (|safety_island#80| state))))
(define-fun |safety_island_n stage_limits.duty_q| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#147| state)) #b1))
(define-fun |safety_island_n stage_limits.duty_share_i| ((state |safety_island_s|)) (_ BitVec 17) (|safety_island#83| state))
(define-fun |safety_island_n stage_limits.duty_ticks_i| ((state |safety_island_s|)) (_ BitVec 21) (|safety_island#85| state))
(define-fun |safety_island_n stage_limits.edges_q| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#144| state)) #b1))
(define-fun |safety_island_n stage_limits.emission_i| ((state |safety_island_s|)) Bool (|safety_island#10| state))
(define-fun |safety_island_n stage_limits.emission_ticks_i| ((state |safety_island_s|)) (_ BitVec 18) (|safety_island#98| state))
(define-fun |safety_island#373| ((state |safety_island_s|)) Bool (bvult (|safety_island#80| state) (concat #b000000000000000000000 (|safety_island#83| state)))) ; \stage_limits.empty
(define-fun |safety_island_n stage_limits.empty| ((state |safety_island_s|)) Bool (|safety_island#373| state))
(define-fun |safety_island_n stage_limits.fetched_first_q| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#353| state)) #b1))
(declare-fun |safety_island#374| (|safety_island_s|) (_ BitVec 1)) ; \stage_limits.fetched_full_q
(define-fun |safety_island_n stage_limits.fetched_full_q| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#374| state)) #b1))
(declare-fun |safety_island#375| (|safety_island_s|) (_ BitVec 1)) ; \stage_limits.fetched_last_q
(define-fun |safety_island_n stage_limits.fetched_last_q| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#375| state)) #b1))
(declare-fun |safety_island#376| (|safety_island_s|) (_ BitVec 4)) ; \stage_limits.fetched_part_q
(define-fun |safety_island_n stage_limits.fetched_part_q| ((state |safety_island_s|)) (_ BitVec 4) (|safety_island#376| state))
(declare-fun |safety_island#377| (|safety_island_s|) (_ BitVec 5)) ; \stage_limits.fetched_q
(define-fun |safety_island_n stage_limits.fetched_q| ((state |safety_island_s|)) (_ BitVec 5) (|safety_island#377| state))
(declare-fun |safety_island#378| (|safety_island_s|) (_ BitVec 1)) ; \stage_limits.first_moves_q
(define-fun |safety_island_n stage_limits.first_moves_q| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#378| state)) #b1))
(declare-fun |safety_island#379| (|safety_island_s|) (_ BitVec 1)) ; \stage_limits.first_round_q
(define-fun |safety_island_n stage_limits.first_round_q| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#379| state)) #b1))
(define-fun |safety_island#380| ((state |safety_island_s|)) (_ BitVec 18) (bvsub (concat #b0 (concat (ite (|safety_island#15| state) #b1 #b0) #b0000000000000000)) (concat #b0 (|safety_island#83| state)))) ; \stage_limits.flow
(define-fun |safety_island_n stage_limits.flow| ((state |safety_island_s|)) (_ BitVec 18) (|safety_island#380| state))
(define-fun |safety_island#381| ((state |safety_island_s|)) Bool (= ((_ extract 37 17) (|safety_island#80| state)) #b111111111111111111111)) ; \stage_limits.full
(define-fun |safety_island_n stage_limits.full| ((state |safety_island_s|)) Bool (|safety_island#381| state))
(declare-fun |safety_island#382| (|safety_island_s|) (_ BitVec 32)) ; \stage_limits.recent_q
(declare-fun |safety_island#383| (|safety_island_s|) (_ BitVec 1)) ; \stage_limits.moved_q
(declare-fun |safety_island#384| (|safety_island_s|) (_ BitVec 1)) ; \stage_limits.soon_q
(define-fun |safety_island#385| ((state |safety_island_s|)) Bool (and (or  (= ((_ extract 0 0) (|safety_island#383| state)) #b1) false) (or  (= ((_ extract 0 0) (|safety_island#384| state)) #b1) false))) ; $flatten\stage_limits.$logic_and$stage_limits.v:118$650_Y
(define-fun |safety_island#386| ((state |safety_island_s|)) (_ BitVec 32) (ite (|safety_island#385| state) (|safety_island#382| state) #b00000000000000000000000000000000)) ; \stage_limits.kept
(define-fun |safety_island_n stage_limits.kept| ((state |safety_island_s|)) (_ BitVec 32) (|safety_island#386| state))
(declare-fun |safety_island#387| (|safety_island_s|) (_ BitVec 1)) ; \stage_limits.last_round_q
(define-fun |safety_island_n stage_limits.last_round_q| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#387| state)) #b1))
(define-fun |safety_island#388| ((state |safety_island_s|)) Bool (bvuge (|safety_island#357| state) (|safety_island#98| state))) ; $flatten\stage_limits.$ge$stage_limits.v:238$690_Y
(define-fun |safety_island#389| ((state |safety_island_s|)) Bool (and (or  (|safety_island#10| state) false) (or  (|safety_island#388| state) false))) ; \stage_limits.late
(define-fun |safety_island_n stage_limits.late| ((state |safety_island_s|)) Bool (|safety_island#389| state))
(define-fun |safety_island_n stage_limits.late_q| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#146| state)) #b1))
(define-fun |safety_island#390| ((state |safety_island_s|)) (_ BitVec 38) (bvadd (|safety_island#80| state) (concat ((_ extract 17 17) (|safety_island#380| state)) (concat ((_ extract 17 17) (|safety_island#380| state)) (concat ((_ extract 17 17) (|safety_island#380| state)) (concat ((_ extract 17 17) (|safety_island#380| state)) (concat ((_ extract 17 17) (|safety_island#380| state)) (concat ((_ extract 17 17) (|safety_island#380| state)) (concat ((_ extract 17 17) (|safety_island#380| state)) (concat ((_ extract 17 17) (|safety_island#380| state)) (concat ((_ extract 17 17) (|safety_island#380| state)) (concat ((_ extract 17 17) (|safety_island#380| state)) (concat ((_ extract 17 17) (|safety_island#380| state)) (concat ((_ extract 17 17) (|safety_island#380| state)) (concat ((_ extract 17 17) (|safety_island#380| state)) (concat ((_ extract 17 17) (|safety_island#380| state)) (concat ((_ extract 17 17) (|safety_island#380| state)) (concat ((_ extract 17 17) (|safety_island#380| state)) (concat ((_ extract 17 17) (|safety_island#380| state)) (concat ((_ extract 17 17) (|safety_island#380| state)) (concat ((_ extract 17 17) (|safety_island#380| state)) (concat ((_ extract 17 17) (|safety_island#380| state)) (|safety_island#380| state))))))))))))))))))))))) ; \stage_limits.level
(define-fun |safety_island_n stage_limits.level| ((state |safety_island_s|)) (_ BitVec 38) (|safety_island#390| state))
(define-fun |safety_island_n stage_limits.level_q| ((state |safety_island_s|)) (_ BitVec 38) (|safety_island#80| state))
(declare-fun |safety_island#391| (|safety_island_s|) (_ BitVec 32)) ; \stage_limits.low_bit[0].count_q
(declare-fun |safety_island#392| (|safety_island_s|) (_ BitVec 5)) ; \stage_limits.turn_q
(define-fun |safety_island#393| ((state |safety_island_s|)) (_ BitVec 1) ((_ extract 0 0) (bvlshr (|safety_island#391| state) (concat #b000000000000000000000000000 (|safety_island#392| state))))) ; \stage_limits.low [0]
(declare-fun |safety_island#394| (|safety_island_s|) (_ BitVec 32)) ; \stage_limits.low_bit[1].count_q
(define-fun |safety_island#395| ((state |safety_island_s|)) (_ BitVec 1) ((_ extract 0 0) (bvlshr (|safety_island#394| state) (concat #b000000000000000000000000000 (|safety_island#392| state))))) ; \stage_limits.low [1]
(declare-fun |safety_island#396| (|safety_island_s|) (_ BitVec 32)) ; \stage_limits.low_bit[2].count_q
(define-fun |safety_island#397| ((state |safety_island_s|)) (_ BitVec 1) ((_ extract 0 0) (bvlshr (|safety_island#396| state) (concat #b000000000000000000000000000 (|safety_island#392| state))))) ; \stage_limits.low [2]
(define-fun |safety_island_n stage_limits.low| ((state |safety_island_s|)) (_ BitVec 3) (concat (|safety_island#397| state) (concat (|safety_island#395| state) (|safety_island#393| state))))
(declare-fun |safety_island#398| (|safety_island_s|) (_ BitVec 3)) ; \stage_limits.low_1_q
(define-fun |safety_island_n stage_limits.low_1_q| ((state |safety_island_s|)) (_ BitVec 3) (|safety_island#398| state))
(define-fun |safety_island_n stage_limits.low_bit[0].count_q| ((state |safety_island_s|)) (_ BitVec 32) (|safety_island#391| state))
(define-fun |safety_island_n stage_limits.low_bit[0].into| ((state |safety_island_s|)) (_ BitVec 32) (|safety_island#368| state))
(define-fun |safety_island_n stage_limits.low_bit[1].count_q| ((state |safety_island_s|)) (_ BitVec 32) (|safety_island#394| state))
(define-fun |safety_island#399| ((state |safety_island_s|)) (_ BitVec 32) (bvand (|safety_island#368| state) (|safety_island#391| state))) ; \stage_limits.low_bit[1].into
(define-fun |safety_island_n stage_limits.low_bit[1].into| ((state |safety_island_s|)) (_ BitVec 32) (|safety_island#399| state))
(define-fun |safety_island_n stage_limits.low_bit[2].count_q| ((state |safety_island_s|)) (_ BitVec 32) (|safety_island#396| state))
(define-fun |safety_island#400| ((state |safety_island_s|)) (_ BitVec 32) (bvand (|safety_island#399| state) (|safety_island#394| state))) ; \stage_limits.low_bit[2].into
(define-fun |safety_island_n stage_limits.low_bit[2].into| ((state |safety_island_s|)) (_ BitVec 32) (|safety_island#400| state))
(declare-fun |safety_island#401| (|safety_island_s|) (_ BitVec 1)) ; \stage_limits.made_last_q
(define-fun |safety_island_n stage_limits.made_last_q| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#401| state)) #b1))
(declare-fun |safety_island#402| (|safety_island_s|) (_ BitVec 32)) ; \stage_limits.made_one_q
(define-fun |safety_island_n stage_limits.made_one_q| ((state |safety_island_s|)) (_ BitVec 32) (|safety_island#402| state))
(declare-fun |safety_island#403| (|safety_island_s|) (_ BitVec 4)) ; \stage_limits.made_part_q
(define-fun |safety_island_n stage_limits.made_part_q| ((state |safety_island_s|)) (_ BitVec 4) (|safety_island#403| state))
(define-fun |safety_island_n stage_limits.made_q| ((state |safety_island_s|)) (_ BitVec 15) (|safety_island#369| state))
(declare-fun |safety_island#404| (|safety_island_s|) (_ BitVec 5)) ; \stage_limits.made_turn_q
(define-fun |safety_island_n stage_limits.made_turn_q| ((state |safety_island_s|)) (_ BitVec 5) (|safety_island#404| state))
(define-fun |safety_island_n stage_limits.moved_q| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#383| state)) #b1))
(define-fun |safety_island_n stage_limits.moves_q| ((state |safety_island_s|)) (_ BitVec 6) (|safety_island#359| state))
(declare-fun |safety_island#405| (|safety_island_s|) (_ BitVec 1)) ; \stage_limits.new_q
(define-fun |safety_island_n stage_limits.new_q| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#405| state)) #b1))
(declare-fun |safety_island#406| (|safety_island_s|) (_ BitVec 1)) ; \stage_limits.none_q
(define-fun |safety_island_n stage_limits.none_q| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#406| state)) #b1))
(declare-fun |safety_island#407| (|safety_island_s|) (_ BitVec 15)) ; \stage_limits.oldest_q
(define-fun |safety_island_n stage_limits.oldest_q| ((state |safety_island_s|)) (_ BitVec 15) (|safety_island#407| state))
(define-fun |safety_island#408| ((state |safety_island_s|)) Bool (not (or  (= ((_ extract 0 0) (|safety_island#392| state)) #b1) (= ((_ extract 1 1) (|safety_island#392| state)) #b1) (= ((_ extract 2 2) (|safety_island#392| state)) #b1) (= ((_ extract 3 3) (|safety_island#392| state)) #b1) (= ((_ extract 4 4) (|safety_island#392| state)) #b1)))) ; $flatten\stage_limits.$eq$stage_limits.v:71$630_Y
(declare-fun |safety_island#409| (|safety_island_s|) (_ BitVec 15)) ; \stage_limits.round_q
(define-fun |safety_island#410| ((state |safety_island_s|)) Bool (not (or  (= ((_ extract 0 0) (|safety_island#409| state)) #b1) (= ((_ extract 1 1) (|safety_island#409| state)) #b1) (= ((_ extract 2 2) (|safety_island#409| state)) #b1) (= ((_ extract 3 3) (|safety_island#409| state)) #b1) (= ((_ extract 4 4) (|safety_island#409| state)) #b1) (= ((_ extract 5 5) (|safety_island#409| state)) #b1) (= ((_ extract 6 6) (|safety_island#409| state)) #b1) (= ((_ extract 7 7) (|safety_island#409| state)) #b1) (= ((_ extract 8 8) (|safety_island#409| state)) #b1) (= ((_ extract 9 9) (|safety_island#409| state)) #b1) (= ((_ extract 10 10) (|safety_island#409| state)) #b1) (= ((_ extract 11 11) (|safety_island#409| state)) #b1) (= ((_ extract 12 12) (|safety_island#409| state)) #b1) (= ((_ extract 13 13) (|safety_island#409| state)) #b1) (= ((_ extract 14 14) (|safety_island#409| state)) #b1)))) ; $flatten\stage_limits.$eq$stage_limits.v:71$631_Y
(define-fun |safety_island#411| ((state |safety_island_s|)) Bool (and (or  (|safety_island#408| state) false) (or  (|safety_island#410| state) false))) ; \stage_limits.part_begins
(define-fun |safety_island_n stage_limits.part_begins| ((state |safety_island_s|)) Bool (|safety_island#411| state))
(declare-fun |safety_island#412| (|safety_island_s|) (_ BitVec 4)) ; \stage_limits.part_q
(define-fun |safety_island_n stage_limits.part_q| ((state |safety_island_s|)) (_ BitVec 4) (|safety_island#412| state))
(define-fun |safety_island_n stage_limits.part_tick| ((state |safety_island_s|)) Bool (|safety_island#371| state))
(declare-fun |safety_island#413| (|safety_island_s|) (_ BitVec 1)) ; \stage_limits.parts_full_q
(define-fun |safety_island_n stage_limits.parts_full_q| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#413| state)) #b1))
(define-fun |safety_island_n stage_limits.pins_q| ((state |safety_island_s|)) (_ BitVec 32) (|safety_island#366| state))
(define-fun |safety_island_n stage_limits.pulse_ticks_i| ((state |safety_island_s|)) (_ BitVec 16) (|safety_island#336| state))
(define-fun |safety_island_n stage_limits.recent_q| ((state |safety_island_s|)) (_ BitVec 32) (|safety_island#382| state))
(define-fun |safety_island_n stage_limits.round_q| ((state |safety_island_s|)) (_ BitVec 15) (|safety_island#409| state))
(define-fun |safety_island_n stage_limits.rst_i| ((state |safety_island_s|)) Bool (|safety_island#6| state))
(define-fun |safety_island#414| ((state |safety_island_s|)) (_ BitVec 32) (bvand (|safety_island#368| state) (|safety_island#382| state))) ; $flatten\stage_limits.$and$stage_limits.v:120$651_Y
(define-fun |safety_island#415| ((state |safety_island_s|)) (_ BitVec 32) (ite (|safety_island#385| state) (|safety_island#414| state) #b00000000000000000000000000000000)) ; \stage_limits.short_pulse
(define-fun |safety_island_n stage_limits.short_pulse| ((state |safety_island_s|)) (_ BitVec 32) (|safety_island#415| state))
(define-fun |safety_island_n stage_limits.short_q| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#143| state)) #b1))
(define-fun |safety_island_n stage_limits.since_q| ((state |safety_island_s|)) (_ BitVec 16) (|safety_island#350| state))
(define-fun |safety_island_n stage_limits.soon_q| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#384| state)) #b1))
(declare-fun |safety_island#416| (|safety_island_s|) Bool) ; \start_i
(define-fun |safety_island_n stage_limits.start_i| ((state |safety_island_s|)) Bool (|safety_island#416| state))
(define-fun |safety_island#417| ((state |safety_island_s|)) Bool (bvugt (|safety_island#370| state) (concat #b0 (|safety_island#66| state)))) ; $flatten\stage_limits.$gt$stage_limits.v:172$663_Y
(define-fun |safety_island#418| ((state |safety_island_s|)) Bool (and (or  (= ((_ extract 0 0) (|safety_island#405| state)) #b1) false) (or  (|safety_island#417| state) false))) ; \stage_limits.too_many
(define-fun |safety_island_n stage_limits.too_many| ((state |safety_island_s|)) Bool (|safety_island#418| state))
(declare-fun |safety_island#419| (|safety_island_s|) (_ BitVec 19)) ; \total_edges_q
(define-fun |safety_island_n stage_limits.total_edges_i| ((state |safety_island_s|)) (_ BitVec 19) (|safety_island#419| state))
(define-fun |safety_island_n stage_limits.total_edges_q| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#145| state)) #b1))
(define-fun |safety_island_n stage_limits.turn_q| ((state |safety_island_s|)) (_ BitVec 5) (|safety_island#392| state))
(define-fun |safety_island#420| ((state |safety_island_s|)) Bool (bvult (|safety_island#398| state) ((_ extract 2 0) (|safety_island#354| state)))) ; \stage_limits.wraps
(define-fun |safety_island_n stage_limits.wraps| ((state |safety_island_s|)) Bool (|safety_island#420| state))
(define-fun |safety_island_n start_i| ((state |safety_island_s|)) Bool (|safety_island#416| state))
(define-fun |safety_island_n started_q| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#22| state)) #b1))
(define-fun |safety_island_n stopping_o| ((state |safety_island_s|)) Bool (|safety_island#245| state))
(define-fun |safety_island_n supply_comes_first_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#79| state)) #b1))
(define-fun |safety_island_n supply_settles_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#79| state)) #b1))
(define-fun |safety_island_n temperature_ok| ((state |safety_island_s|)) Bool (= ((_ extract 1 1) (|safety_island#47| state)) #b1))
(declare-fun |safety_island#421| (|safety_island_s|) Bool) ; \temperature_ok_i
(define-fun |safety_island_n temperature_ok_i| ((state |safety_island_s|)) Bool (|safety_island#421| state))
(define-fun |safety_island_n temperature_ok_o| ((state |safety_island_s|)) Bool (= ((_ extract 1 1) (|safety_island#47| state)) #b1))
(define-fun |safety_island_n temperature_ok_q| ((state |safety_island_s|)) (_ BitVec 2) (|safety_island#47| state))
(define-fun |safety_island#422| ((state |safety_island_s|)) Bool (bvult (|safety_island#349| state) (concat #b00 (|safety_island#335| state)))) ; $lt$safety_island_end_to_end_properties.vh:92$314_Y
(define-fun |safety_island#423| ((state |safety_island_s|)) Bool (and (or  (|safety_island#92| state) false) (or  (|safety_island#422| state) false))) ; \too_soon
(define-fun |safety_island_n too_soon| ((state |safety_island_s|)) Bool (|safety_island#423| state))
(declare-fun |safety_island#424| (|safety_island_s|) (_ BitVec 19)) ; \total_1_q
(define-fun |safety_island_n total_1_q| ((state |safety_island_s|)) (_ BitVec 19) (|safety_island#424| state))
(define-fun |safety_island_n total_edges_i| ((state |safety_island_s|)) (_ BitVec 32) (|safety_island#174| state))
(define-fun |safety_island_n total_edges_q| ((state |safety_island_s|)) (_ BitVec 19) (|safety_island#419| state))
(declare-fun |safety_island#425| (|safety_island_s|) (_ BitVec 32)) ; \total_most_g
(define-fun |safety_island_n total_most_g| ((state |safety_island_s|)) (_ BitVec 32) (|safety_island#425| state))
(define-fun |safety_island_n underrun_i| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#220| state)) #b1))
(define-fun |safety_island_n underruns_o| ((state |safety_island_s|)) (_ BitVec 32) (|safety_island#324| state))
(declare-fun |safety_island#426| (|safety_island_s|) (_ BitVec 32)) ; \up_g
(define-fun |safety_island_n up_g| ((state |safety_island_s|)) (_ BitVec 32) (|safety_island#426| state))
(define-fun |safety_island_n wishes_are_linked_EN| ((state |safety_island_s|)) Bool (= ((_ extract 0 0) (|safety_island#52| state)) #b1))
(define-fun |safety_island#427| ((state |safety_island_s|)) (_ BitVec 1) (bvnot (ite (|safety_island#69| state) #b1 #b0))) ; $auto$rtlil.cc:3245:Not$3269
(define-fun |safety_island_u 0| ((state |safety_island_s|)) Bool (or (= ((_ extract 0 0) (|safety_island#427| state)) #b1) (not true))) ; $auto$formalff.cc:987:execute$3270
(define-fun |safety_island#428| ((state |safety_island_s|)) (_ BitVec 3) (bvand ((_ extract 2 0) (|safety_island#183| state)) (|safety_island#275| state))) ; $and$safety_island_end_to_end_links.vh:38$529_Y
(define-fun |safety_island#429| ((state |safety_island_s|)) Bool (not (or  (= ((_ extract 0 0) (|safety_island#428| state)) #b1) (= ((_ extract 1 1) (|safety_island#428| state)) #b1) (= ((_ extract 2 2) (|safety_island#428| state)) #b1)))) ; $eq$safety_island_end_to_end_links.vh:38$530_Y
(define-fun |safety_island#430| ((state |safety_island_s|)) Bool (and (or  (= ((_ extract 3 3) (|safety_island#183| state)) #b1) false) (or  (= ((_ extract 0 0) (|safety_island#30| state)) #b1) false))) ; $logic_and$safety_island_end_to_end_links.vh:38$531_Y
(define-fun |safety_island#431| ((state |safety_island_s|)) Bool (not (or  (|safety_island#430| state) false))) ; $logic_not$safety_island_end_to_end_links.vh:38$532_Y
(define-fun |safety_island#432| ((state |safety_island_s|)) Bool (and (or  (|safety_island#429| state) false) (or  (|safety_island#431| state) false))) ; $logic_and$safety_island_end_to_end_links.vh:38$533_Y
(define-fun |safety_island_a 0| ((state |safety_island_s|)) Bool (or (|safety_island#432| state) (not (= ((_ extract 0 0) (|safety_island#52| state)) #b1)))) ; _witness_.assert_assert_safety_island_end_to_end_links_vh_38_528
(define-fun |safety_island#433| ((state |safety_island_s|)) Bool (= (|safety_island#426| state) (concat #b0000000000000000 (|safety_island#326| state)))) ; $eq$safety_island_end_to_end_links.vh:39$536_Y
(define-fun |safety_island#434| ((state |safety_island_s|)) Bool (distinct (|safety_island#5| state) #b00000)) ; $ne$safety_island_end_to_end_links.vh:39$534_Y
(define-fun |safety_island#435| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#434| state) #b1 #b0)) ; $procmux$1800_Y
(define-fun |safety_island#436| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#25| state) (|safety_island#435| state) #b0)) ; $assert$safety_island_end_to_end_links.vh:39$535_EN
(define-fun |safety_island_a 1| ((state |safety_island_s|)) Bool (or (|safety_island#433| state) (not (= ((_ extract 0 0) (|safety_island#436| state)) #b1)))) ; _witness_.assert_assert_safety_island_end_to_end_links_vh_39_535
(define-fun |safety_island#437| ((state |safety_island_s|)) Bool (not (or  (= ((_ extract 0 0) (|safety_island#59| state)) #b1) (= ((_ extract 1 1) (|safety_island#59| state)) #b1) (= ((_ extract 2 2) (|safety_island#59| state)) #b1) (= ((_ extract 3 3) (|safety_island#59| state)) #b1) (= ((_ extract 4 4) (|safety_island#59| state)) #b1) (= ((_ extract 5 5) (|safety_island#59| state)) #b1) (= ((_ extract 6 6) (|safety_island#59| state)) #b1) (= ((_ extract 7 7) (|safety_island#59| state)) #b1) (= ((_ extract 8 8) (|safety_island#59| state)) #b1) (= ((_ extract 9 9) (|safety_island#59| state)) #b1) (= ((_ extract 10 10) (|safety_island#59| state)) #b1) (= ((_ extract 11 11) (|safety_island#59| state)) #b1) (= ((_ extract 12 12) (|safety_island#59| state)) #b1) (= ((_ extract 13 13) (|safety_island#59| state)) #b1) (= ((_ extract 14 14) (|safety_island#59| state)) #b1) (= ((_ extract 15 15) (|safety_island#59| state)) #b1) (= ((_ extract 16 16) (|safety_island#59| state)) #b1) (= ((_ extract 17 17) (|safety_island#59| state)) #b1) (= ((_ extract 18 18) (|safety_island#59| state)) #b1) (= ((_ extract 19 19) (|safety_island#59| state)) #b1) (= ((_ extract 20 20) (|safety_island#59| state)) #b1) (= ((_ extract 21 21) (|safety_island#59| state)) #b1) (= ((_ extract 22 22) (|safety_island#59| state)) #b1) (= ((_ extract 23 23) (|safety_island#59| state)) #b1) (= ((_ extract 24 24) (|safety_island#59| state)) #b1) (= ((_ extract 25 25) (|safety_island#59| state)) #b1) (= ((_ extract 26 26) (|safety_island#59| state)) #b1) (= ((_ extract 27 27) (|safety_island#59| state)) #b1) (= ((_ extract 28 28) (|safety_island#59| state)) #b1) (= ((_ extract 29 29) (|safety_island#59| state)) #b1) (= ((_ extract 30 30) (|safety_island#59| state)) #b1) (= ((_ extract 31 31) (|safety_island#59| state)) #b1)))) ; $eq$safety_island_end_to_end_links.vh:42$547_Y
(define-fun |safety_island#438| ((state |safety_island_s|)) Bool (not (or  (= ((_ extract 0 0) (|safety_island#125| state)) #b1) false))) ; $logic_not$safety_island_end_to_end_links.vh:42$548_Y
(define-fun |safety_island#439| ((state |safety_island_s|)) Bool (= (ite (|safety_island#437| state) #b1 #b0) (ite (|safety_island#438| state) #b1 #b0))) ; $eq$safety_island_end_to_end_links.vh:42$549_Y
(define-fun |safety_island_a 2| ((state |safety_island_s|)) Bool (or (|safety_island#439| state) (not (= ((_ extract 0 0) (|safety_island#62| state)) #b1)))) ; _witness_.assert_assert_safety_island_end_to_end_links_vh_42_546
(define-fun |safety_island#440| ((state |safety_island_s|)) Bool (= (|safety_island#64| state) (|safety_island#366| state))) ; $eq$safety_island_end_to_end_links.vh:44$551_Y
(define-fun |safety_island_a 3| ((state |safety_island_s|)) Bool (or (|safety_island#440| state) (not (= ((_ extract 0 0) (|safety_island#52| state)) #b1)))) ; _witness_.assert_assert_safety_island_end_to_end_links_vh_44_550
(define-fun |safety_island#441| ((state |safety_island_s|)) (_ BitVec 1) ((_ extract 0 0) (bvlshr (|safety_island#368| state) (concat #b000000000000000000000000000 (|safety_island#89| state))))) ; $shiftx$safety_island_end_to_end_links.vh:45$553_Y
(define-fun |safety_island#442| ((state |safety_island_s|)) Bool (= (|safety_island#88| state) (|safety_island#441| state))) ; $eq$safety_island_end_to_end_links.vh:45$554_Y
(define-fun |safety_island#443| ((state |safety_island_s|)) Bool (distinct (|safety_island#368| state) #b00000000000000000000000000000000)) ; $ne$safety_island_end_to_end_links.vh:45$555_Y
(define-fun |safety_island#444| ((state |safety_island_s|)) Bool (= (|safety_island#383| state) (ite (|safety_island#443| state) #b1 #b0))) ; $eq$safety_island_end_to_end_links.vh:45$556_Y
(define-fun |safety_island#445| ((state |safety_island_s|)) Bool (and (or  (|safety_island#442| state) false) (or  (|safety_island#444| state) false))) ; $logic_and$safety_island_end_to_end_links.vh:45$557_Y
(define-fun |safety_island_a 4| ((state |safety_island_s|)) Bool (or (|safety_island#445| state) (not (= ((_ extract 0 0) (|safety_island#52| state)) #b1)))) ; _witness_.assert_assert_safety_island_end_to_end_links_vh_45_552
(define-fun |safety_island#446| ((state |safety_island_s|)) Bool (bvule (|safety_island#348| state) #b100000000000000000)) ; $le$safety_island_end_to_end_links.vh:49$568_Y
(define-fun |safety_island#447| ((state |safety_island_s|)) Bool (bvule (concat #b00 (|safety_island#350| state)) (|safety_island#348| state))) ; $le$safety_island_end_to_end_links.vh:49$569_Y
(define-fun |safety_island#448| ((state |safety_island_s|)) Bool (and (or  (|safety_island#446| state) false) (or  (|safety_island#447| state) false))) ; $logic_and$safety_island_end_to_end_links.vh:49$570_Y
(define-fun |safety_island#449| ((state |safety_island_s|)) Bool (bvule (|safety_island#349| state) #b100000000000000000)) ; $le$safety_island_end_to_end_links.vh:49$571_Y
(define-fun |safety_island#450| ((state |safety_island_s|)) Bool (and (or  (|safety_island#448| state) false) (or  (|safety_island#449| state) false))) ; $logic_and$safety_island_end_to_end_links.vh:49$572_Y
(define-fun |safety_island_a 5| ((state |safety_island_s|)) Bool (or (|safety_island#450| state) (not (= ((_ extract 0 0) (|safety_island#52| state)) #b1)))) ; _witness_.assert_assert_safety_island_end_to_end_links_vh_49_567
(define-fun |safety_island#451| ((state |safety_island_s|)) Bool (= (|safety_island#348| state) #b100000000000000000)) ; $eq$safety_island_end_to_end_links.vh:50$574_Y
(define-fun |safety_island#452| ((state |safety_island_s|)) Bool (or  (= ((_ extract 0 0) (|safety_island#88| state)) #b1) false  (|safety_island#451| state) false)) ; $logic_or$safety_island_end_to_end_links.vh:51$582_Y
(define-fun |safety_island#453| ((state |safety_island_s|)) (_ BitVec 18) (bvadd (|safety_island#348| state) #b000000000000000001)) ; $add$safety_island_end_to_end_links.vh:51$583_Y
(define-fun |safety_island#454| ((state |safety_island_s|)) Bool (= (|safety_island#349| state) (|safety_island#453| state))) ; $eq$safety_island_end_to_end_links.vh:51$584_Y
(define-fun |safety_island#455| ((state |safety_island_s|)) Bool (or  (|safety_island#452| state) false  (|safety_island#454| state) false)) ; $logic_or$safety_island_end_to_end_links.vh:51$585_Y
(define-fun |safety_island#456| ((state |safety_island_s|)) Bool (distinct (|safety_island#349| state) #b100000000000000000)) ; $ne$safety_island_end_to_end_links.vh:51$579_Y
(define-fun |safety_island#457| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#456| state) #b1 #b0)) ; $procmux$1776_Y
(define-fun |safety_island#458| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#25| state) (|safety_island#457| state) #b0)) ; $assert$safety_island_end_to_end_links.vh:51$580_EN
(define-fun |safety_island_a 6| ((state |safety_island_s|)) Bool (or (|safety_island#455| state) (not (= ((_ extract 0 0) (|safety_island#458| state)) #b1)))) ; _witness_.assert_assert_safety_island_end_to_end_links_vh_51_580
(define-fun |safety_island#459| ((state |safety_island_s|)) Bool (bvult (|safety_island#348| state) (concat #b00 (|safety_island#134| state)))) ; $lt$safety_island_end_to_end_links.vh:52$587_Y
(define-fun |safety_island#460| ((state |safety_island_s|)) Bool (and (or  (= ((_ extract 0 0) (|safety_island#88| state)) #b1) false) (or  (|safety_island#459| state) false))) ; $logic_and$safety_island_end_to_end_links.vh:52$588_Y
(define-fun |safety_island#461| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#343| state)) #b1) #b1 #b0)) ; $procmux$1772_Y
(define-fun |safety_island#462| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#25| state) (|safety_island#461| state) #b0)) ; $assert$safety_island_end_to_end_links.vh:52$586_EN
(define-fun |safety_island_a 7| ((state |safety_island_s|)) Bool (or (|safety_island#460| state) (not (= ((_ extract 0 0) (|safety_island#462| state)) #b1)))) ; _witness_.assert_assert_safety_island_end_to_end_links_vh_52_586
(define-fun |safety_island#463| ((state |safety_island_s|)) Bool (not (or  (= ((_ extract 38 38) (|safety_island#327| state)) #b1) false))) ; $logic_not$safety_island_end_to_end_links.vh:54$593_Y
(define-fun |safety_island#464| ((state |safety_island_s|)) Bool (bvsle (|safety_island#327| state) #b001011011100011011000100000000000000000)) ; $le$safety_island_end_to_end_links.vh:54$594_Y
(define-fun |safety_island#465| ((state |safety_island_s|)) Bool (and (or  (|safety_island#463| state) false) (or  (|safety_island#464| state) false))) ; $logic_and$safety_island_end_to_end_links.vh:54$595_Y
(define-fun |safety_island_a 8| ((state |safety_island_s|)) Bool (or (|safety_island#465| state) (not (= ((_ extract 0 0) (|safety_island#52| state)) #b1)))) ; _witness_.assert_assert_safety_island_end_to_end_links_vh_54_592
(define-fun |safety_island#466| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 1 1) (|safety_island#343| state)) #b1) #b1 #b0)) ; $procmux$1760_Y
(define-fun |safety_island#467| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#25| state) (|safety_island#466| state) #b0)) ; $assert$safety_island_end_to_end_links.vh:56$597_EN
(define-fun |safety_island_a 9| ((state |safety_island_s|)) Bool (or (= ((_ extract 0 0) (|safety_island#143| state)) #b1) (not (= ((_ extract 0 0) (|safety_island#467| state)) #b1)))) ; _witness_.assert_assert_safety_island_end_to_end_links_vh_56_597
(define-fun |safety_island#468| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#133| state)) #b1) #b1 #b0)) ; $procmux$1756_Y
(define-fun |safety_island#469| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#25| state) (|safety_island#468| state) #b0)) ; $assert$safety_island_end_to_end_links.vh:57$598_EN
(define-fun |safety_island_a 10| ((state |safety_island_s|)) Bool (or (= ((_ extract 0 0) (|safety_island#146| state)) #b1) (not (= ((_ extract 0 0) (|safety_island#469| state)) #b1)))) ; _witness_.assert_assert_safety_island_end_to_end_links_vh_57_598
(define-fun |safety_island#470| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#176| state)) #b1) #b1 #b0)) ; $procmux$1752_Y
(define-fun |safety_island#471| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#25| state) (|safety_island#470| state) #b0)) ; $assert$safety_island_end_to_end_links.vh:58$599_EN
(define-fun |safety_island_a 11| ((state |safety_island_s|)) Bool (or (= ((_ extract 0 0) (|safety_island#147| state)) #b1) (not (= ((_ extract 0 0) (|safety_island#471| state)) #b1)))) ; _witness_.assert_assert_safety_island_end_to_end_links_vh_58_599
(define-fun |safety_island#472| ((state |safety_island_s|)) Bool (not (or  (= ((_ extract 2 2) (|safety_island#343| state)) #b1) false))) ; $logic_not$safety_island_end_to_end_links.vh:59$601_Y
(define-fun |safety_island#473| ((state |safety_island_s|)) Bool (or  (|safety_island#472| state) false  (= ((_ extract 0 0) (|safety_island#214| state)) #b1) false)) ; $logic_or$safety_island_end_to_end_links.vh:59$602_Y
(define-fun |safety_island#474| ((state |safety_island_s|)) Bool (not (or  (= ((_ extract 1 1) (|safety_island#133| state)) #b1) false))) ; $logic_not$safety_island_end_to_end_links.vh:59$603_Y
(define-fun |safety_island#475| ((state |safety_island_s|)) Bool (or  (|safety_island#474| state) false  (= ((_ extract 3 3) (|safety_island#214| state)) #b1) false)) ; $logic_or$safety_island_end_to_end_links.vh:59$604_Y
(define-fun |safety_island#476| ((state |safety_island_s|)) Bool (and (or  (|safety_island#473| state) false) (or  (|safety_island#475| state) false))) ; $logic_and$safety_island_end_to_end_links.vh:59$605_Y
(define-fun |safety_island#477| ((state |safety_island_s|)) Bool (not (or  (= ((_ extract 1 1) (|safety_island#176| state)) #b1) false))) ; $logic_not$safety_island_end_to_end_links.vh:59$606_Y
(define-fun |safety_island#478| ((state |safety_island_s|)) Bool (or  (|safety_island#477| state) false  (= ((_ extract 4 4) (|safety_island#214| state)) #b1) false)) ; $logic_or$safety_island_end_to_end_links.vh:59$607_Y
(define-fun |safety_island#479| ((state |safety_island_s|)) Bool (and (or  (|safety_island#476| state) false) (or  (|safety_island#478| state) false))) ; $logic_and$safety_island_end_to_end_links.vh:59$608_Y
(define-fun |safety_island_a 12| ((state |safety_island_s|)) Bool (or (|safety_island#479| state) (not (= ((_ extract 0 0) (|safety_island#52| state)) #b1)))) ; _witness_.assert_assert_safety_island_end_to_end_links_vh_59_600
(define-fun |safety_island#480| ((state |safety_island_s|)) Bool (bvule (|safety_island#206| state) #b1111010000100100)) ; $flatten\output_gate.$le$output_gate_properties.vh:130$1120_Y
(define-fun |safety_island#481| ((state |safety_island_s|)) Bool (bvule (|safety_island#202| state) #b1111010000100100)) ; $flatten\output_gate.$le$output_gate_properties.vh:130$1121_Y
(define-fun |safety_island#482| ((state |safety_island_s|)) Bool (and (or  (|safety_island#480| state) false) (or  (|safety_island#481| state) false))) ; $flatten\output_gate.$logic_and$output_gate_properties.vh:130$1122_Y
(define-fun |safety_island#483| ((state |safety_island_s|)) Bool (bvule (|safety_island#203| state) #b1111010000100100)) ; $flatten\output_gate.$le$output_gate_properties.vh:130$1123_Y
(define-fun |safety_island#484| ((state |safety_island_s|)) Bool (and (or  (|safety_island#482| state) false) (or  (|safety_island#483| state) false))) ; $flatten\output_gate.$logic_and$output_gate_properties.vh:130$1124_Y
(define-fun |safety_island#485| ((state |safety_island_s|)) Bool (bvule (|safety_island#204| state) #b1111010000100100)) ; $flatten\output_gate.$le$output_gate_properties.vh:130$1125_Y
(define-fun |safety_island#486| ((state |safety_island_s|)) Bool (and (or  (|safety_island#484| state) false) (or  (|safety_island#485| state) false))) ; $flatten\output_gate.$logic_and$output_gate_properties.vh:130$1126_Y
(define-fun |safety_island#487| ((state |safety_island_s|)) Bool (bvule (|safety_island#205| state) #b1111010000100100)) ; $flatten\output_gate.$le$output_gate_properties.vh:130$1127_Y
(define-fun |safety_island#488| ((state |safety_island_s|)) Bool (and (or  (|safety_island#486| state) false) (or  (|safety_island#487| state) false))) ; $flatten\output_gate.$logic_and$output_gate_properties.vh:130$1128_Y
(define-fun |safety_island_a 13| ((state |safety_island_s|)) Bool (or (|safety_island#488| state) (not (= ((_ extract 0 0) (|safety_island#210| state)) #b1)))) ; _witness_.assert_flatten_output_gate__assert_output_gate_properties_vh_130_1119
(define-fun |safety_island#489| ((state |safety_island_s|)) Bool (bvule (|safety_island#326| state) #b1111010000100100)) ; $flatten\output_gate.$le$output_gate_properties.vh:131$1130_Y
(define-fun |safety_island_a 14| ((state |safety_island_s|)) Bool (or (|safety_island#489| state) (not (= ((_ extract 0 0) (|safety_island#210| state)) #b1)))) ; _witness_.assert_flatten_output_gate__assert_output_gate_properties_vh_131_1129
(define-fun |safety_island#490| ((state |safety_island_s|)) Bool (not (or  (= ((_ extract 0 0) (|safety_island#73| state)) #b1) (= ((_ extract 1 1) (|safety_island#73| state)) #b1) (= ((_ extract 2 2) (|safety_island#73| state)) #b1) (= ((_ extract 3 3) (|safety_island#73| state)) #b1) (= ((_ extract 4 4) (|safety_island#73| state)) #b1) (= ((_ extract 5 5) (|safety_island#73| state)) #b1) (= ((_ extract 6 6) (|safety_island#73| state)) #b1) (= ((_ extract 7 7) (|safety_island#73| state)) #b1) (= ((_ extract 8 8) (|safety_island#73| state)) #b1)))) ; $flatten\output_gate.$eq$output_gate_properties.vh:135$1142_Y
(define-fun |safety_island#491| ((state |safety_island_s|)) Bool (and (or  (|safety_island#490| state) false) (or  (= ((_ extract 0 0) (|safety_island#208| state)) #b1) false))) ; $flatten\output_gate.$logic_and$output_gate_properties.vh:135$1143_Y
(define-fun |safety_island#492| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#23| state) #b0 (|safety_island#21| state))) ; $flatten\output_gate.$procmux$2060_Y
(define-fun |safety_island#493| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#22| state)) #b1) (|safety_island#492| state) #b0)) ; $flatten\output_gate.$assert$output_gate_properties.vh:135$1141_EN
(define-fun |safety_island_a 15| ((state |safety_island_s|)) Bool (or (|safety_island#491| state) (not (= ((_ extract 0 0) (|safety_island#493| state)) #b1)))) ; _witness_.assert_flatten_output_gate__assert_output_gate_properties_vh_135_1141
(define-fun |safety_island#494| ((state |safety_island_s|)) Bool (distinct (|safety_island#325| state) #b00000000000000000000000000000000)) ; $flatten\output_gate.$ne$output_gate_properties.vh:137$1148_Y
(define-fun |safety_island#495| ((state |safety_island_s|)) Bool (and (or  (= ((_ extract 0 0) (|safety_island#253| state)) #b1) false) (or  (|safety_island#494| state) false))) ; $flatten\output_gate.$logic_and$output_gate_properties.vh:137$1149_Y
(define-fun |safety_island_a 16| ((state |safety_island_s|)) Bool (or (|safety_island#495| state) (not (= ((_ extract 0 0) (|safety_island#308| state)) #b1)))) ; _witness_.assert_flatten_output_gate__assert_output_gate_properties_vh_137_1147
(define-fun |safety_island#496| ((state |safety_island_s|)) (_ BitVec 33) (bvadd (concat #b0 (|safety_island#254| state)) #b000000000000000000000000000000001)) ; $flatten\output_gate.$add$output_gate_properties.vh:119$1088_Y
(define-fun |safety_island#497| ((state |safety_island_s|)) Bool (bvule (concat #b0 (|safety_island#325| state)) (|safety_island#496| state))) ; $flatten\output_gate.$le$output_gate_properties.vh:119$1089_Y
(define-fun |safety_island#498| ((state |safety_island_s|)) Bool (bvule (|safety_island#325| state) #b00000000000000000000000000000010)) ; $flatten\output_gate.$le$output_gate_properties.vh:119$1090_Y
(define-fun |safety_island#499| ((state |safety_island_s|)) Bool (or  (|safety_island#497| state) false  (|safety_island#498| state) false)) ; $flatten\output_gate.$logic_or$output_gate_properties.vh:119$1091_Y
(define-fun |safety_island#500| ((state |safety_island_s|)) Bool (and (or  (|safety_island#495| state) false) (or  (|safety_island#499| state) false))) ; $flatten\output_gate.$logic_and$output_gate_properties.vh:140$1168_Y
(define-fun |safety_island_a 17| ((state |safety_island_s|)) Bool (or (|safety_island#500| state) (not (= ((_ extract 0 0) (|safety_island#493| state)) #b1)))) ; _witness_.assert_flatten_output_gate__assert_output_gate_properties_vh_140_1161
(define-fun |safety_island#501| ((state |safety_island_s|)) Bool (= (|safety_island#202| state) #b1111010000100100)) ; $flatten\output_gate.$eq$output_gate_properties.vh:143$1176_Y
(define-fun |safety_island#502| ((state |safety_island_s|)) Bool (and (or  (= ((_ extract 0 0) (|safety_island#275| state)) #b1) false) (or  (|safety_island#501| state) false))) ; $flatten\output_gate.$logic_and$output_gate_properties.vh:143$1177_Y
(define-fun |safety_island#503| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#268| state)) #b1) #b1 #b0)) ; $flatten\output_gate.$procmux$2034_Y
(define-fun |safety_island#504| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#23| state) #b0 (|safety_island#503| state))) ; $flatten\output_gate.$procmux$2036_Y
(define-fun |safety_island#505| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#22| state)) #b1) (|safety_island#504| state) #b0)) ; $flatten\output_gate.$assert$output_gate_properties.vh:143$1175_EN
(define-fun |safety_island_a 18| ((state |safety_island_s|)) Bool (or (|safety_island#502| state) (not (= ((_ extract 0 0) (|safety_island#505| state)) #b1)))) ; _witness_.assert_flatten_output_gate__assert_output_gate_properties_vh_143_1175
(define-fun |safety_island#506| ((state |safety_island_s|)) Bool (= (|safety_island#203| state) #b1111010000100100)) ; $flatten\output_gate.$eq$output_gate_properties.vh:144$1179_Y
(define-fun |safety_island#507| ((state |safety_island_s|)) Bool (and (or  (= ((_ extract 1 1) (|safety_island#275| state)) #b1) false) (or  (|safety_island#506| state) false))) ; $flatten\output_gate.$logic_and$output_gate_properties.vh:144$1180_Y
(define-fun |safety_island#508| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 1 1) (|safety_island#268| state)) #b1) #b1 #b0)) ; $flatten\output_gate.$procmux$2026_Y
(define-fun |safety_island#509| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#23| state) #b0 (|safety_island#508| state))) ; $flatten\output_gate.$procmux$2028_Y
(define-fun |safety_island#510| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#22| state)) #b1) (|safety_island#509| state) #b0)) ; $flatten\output_gate.$assert$output_gate_properties.vh:144$1178_EN
(define-fun |safety_island_a 19| ((state |safety_island_s|)) Bool (or (|safety_island#507| state) (not (= ((_ extract 0 0) (|safety_island#510| state)) #b1)))) ; _witness_.assert_flatten_output_gate__assert_output_gate_properties_vh_144_1178
(define-fun |safety_island#511| ((state |safety_island_s|)) Bool (= (|safety_island#204| state) #b1111010000100100)) ; $flatten\output_gate.$eq$output_gate_properties.vh:145$1182_Y
(define-fun |safety_island#512| ((state |safety_island_s|)) Bool (and (or  (= ((_ extract 2 2) (|safety_island#275| state)) #b1) false) (or  (|safety_island#511| state) false))) ; $flatten\output_gate.$logic_and$output_gate_properties.vh:145$1183_Y
(define-fun |safety_island#513| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 2 2) (|safety_island#268| state)) #b1) #b1 #b0)) ; $flatten\output_gate.$procmux$2018_Y
(define-fun |safety_island#514| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#23| state) #b0 (|safety_island#513| state))) ; $flatten\output_gate.$procmux$2020_Y
(define-fun |safety_island#515| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#22| state)) #b1) (|safety_island#514| state) #b0)) ; $flatten\output_gate.$assert$output_gate_properties.vh:145$1181_EN
(define-fun |safety_island_a 20| ((state |safety_island_s|)) Bool (or (|safety_island#512| state) (not (= ((_ extract 0 0) (|safety_island#515| state)) #b1)))) ; _witness_.assert_flatten_output_gate__assert_output_gate_properties_vh_145_1181
(define-fun |safety_island#516| ((state |safety_island_s|)) (_ BitVec 16) (bvadd (|safety_island#202| state) #b0000000000000001)) ; $flatten\output_gate.$add$output_gate_properties.vh:15$1192_Y
(define-fun |safety_island#517| ((state |safety_island_s|)) (_ BitVec 16) (ite (|safety_island#501| state) #b1111010000100100 (|safety_island#516| state))) ; $flatten\output_gate.$ternary$output_gate_properties.vh:15$1193_Y
(define-fun |safety_island#518| ((state |safety_island_s|)) Bool (= (|safety_island#206| state) (|safety_island#517| state))) ; $flatten\output_gate.$eq$output_gate_properties.vh:147$1195_Y
(define-fun |safety_island#519| ((state |safety_island_s|)) Bool (and (or  (= ((_ extract 0 0) (|safety_island#275| state)) #b1) false) (or  (|safety_island#518| state) false))) ; $flatten\output_gate.$logic_and$output_gate_properties.vh:147$1196_Y
(define-fun |safety_island#520| ((state |safety_island_s|)) Bool (distinct (|safety_island#206| state) #b0000000000000000)) ; $flatten\output_gate.$ne$output_gate_properties.vh:147$1187_Y
(define-fun |safety_island#521| ((state |safety_island_s|)) Bool (and (or  (|safety_island#248| state) false) (or  (|safety_island#520| state) false))) ; $flatten\output_gate.$logic_and$output_gate_properties.vh:147$1188_Y
(define-fun |safety_island#522| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#521| state) #b1 #b0)) ; $flatten\output_gate.$procmux$2002_Y
(define-fun |safety_island#523| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#23| state) #b0 (|safety_island#522| state))) ; $flatten\output_gate.$procmux$2004_Y
(define-fun |safety_island#524| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#22| state)) #b1) (|safety_island#523| state) #b0)) ; $flatten\output_gate.$assert$output_gate_properties.vh:147$1194_EN
(define-fun |safety_island_a 21| ((state |safety_island_s|)) Bool (or (|safety_island#519| state) (not (= ((_ extract 0 0) (|safety_island#524| state)) #b1)))) ; _witness_.assert_flatten_output_gate__assert_output_gate_properties_vh_147_1194
(define-fun |safety_island#525| ((state |safety_island_s|)) (_ BitVec 16) (bvadd (|safety_island#203| state) #b0000000000000001)) ; $flatten\output_gate.$add$output_gate_properties.vh:15$1202_Y
(define-fun |safety_island#526| ((state |safety_island_s|)) (_ BitVec 16) (ite (|safety_island#506| state) #b1111010000100100 (|safety_island#525| state))) ; $flatten\output_gate.$ternary$output_gate_properties.vh:15$1203_Y
(define-fun |safety_island#527| ((state |safety_island_s|)) Bool (= (|safety_island#202| state) (|safety_island#526| state))) ; $flatten\output_gate.$eq$output_gate_properties.vh:148$1205_Y
(define-fun |safety_island#528| ((state |safety_island_s|)) Bool (and (or  (= ((_ extract 1 1) (|safety_island#275| state)) #b1) false) (or  (|safety_island#527| state) false))) ; $flatten\output_gate.$logic_and$output_gate_properties.vh:148$1206_Y
(define-fun |safety_island#529| ((state |safety_island_s|)) Bool (distinct (|safety_island#202| state) #b0000000000000000)) ; $flatten\output_gate.$ne$output_gate_properties.vh:148$1197_Y
(define-fun |safety_island#530| ((state |safety_island_s|)) Bool (and (or  (= ((_ extract 0 0) (|safety_island#275| state)) #b1) false) (or  (|safety_island#529| state) false))) ; $flatten\output_gate.$logic_and$output_gate_properties.vh:148$1198_Y
(define-fun |safety_island#531| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#530| state) #b1 #b0)) ; $flatten\output_gate.$procmux$1993_Y
(define-fun |safety_island#532| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#23| state) #b0 (|safety_island#531| state))) ; $flatten\output_gate.$procmux$1995_Y
(define-fun |safety_island#533| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#22| state)) #b1) (|safety_island#532| state) #b0)) ; $flatten\output_gate.$assert$output_gate_properties.vh:148$1204_EN
(define-fun |safety_island_a 22| ((state |safety_island_s|)) Bool (or (|safety_island#528| state) (not (= ((_ extract 0 0) (|safety_island#533| state)) #b1)))) ; _witness_.assert_flatten_output_gate__assert_output_gate_properties_vh_148_1204
(define-fun |safety_island#534| ((state |safety_island_s|)) (_ BitVec 16) (bvadd (|safety_island#204| state) #b0000000000000001)) ; $flatten\output_gate.$add$output_gate_properties.vh:15$1212_Y
(define-fun |safety_island#535| ((state |safety_island_s|)) (_ BitVec 16) (ite (|safety_island#511| state) #b1111010000100100 (|safety_island#534| state))) ; $flatten\output_gate.$ternary$output_gate_properties.vh:15$1213_Y
(define-fun |safety_island#536| ((state |safety_island_s|)) Bool (= (|safety_island#203| state) (|safety_island#535| state))) ; $flatten\output_gate.$eq$output_gate_properties.vh:149$1215_Y
(define-fun |safety_island#537| ((state |safety_island_s|)) Bool (and (or  (= ((_ extract 2 2) (|safety_island#275| state)) #b1) false) (or  (|safety_island#536| state) false))) ; $flatten\output_gate.$logic_and$output_gate_properties.vh:149$1216_Y
(define-fun |safety_island#538| ((state |safety_island_s|)) Bool (distinct (|safety_island#203| state) #b0000000000000000)) ; $flatten\output_gate.$ne$output_gate_properties.vh:149$1207_Y
(define-fun |safety_island#539| ((state |safety_island_s|)) Bool (and (or  (= ((_ extract 1 1) (|safety_island#275| state)) #b1) false) (or  (|safety_island#538| state) false))) ; $flatten\output_gate.$logic_and$output_gate_properties.vh:149$1208_Y
(define-fun |safety_island#540| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#539| state) #b1 #b0)) ; $flatten\output_gate.$procmux$1984_Y
(define-fun |safety_island#541| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#23| state) #b0 (|safety_island#540| state))) ; $flatten\output_gate.$procmux$1986_Y
(define-fun |safety_island#542| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#22| state)) #b1) (|safety_island#541| state) #b0)) ; $flatten\output_gate.$assert$output_gate_properties.vh:149$1214_EN
(define-fun |safety_island_a 23| ((state |safety_island_s|)) Bool (or (|safety_island#537| state) (not (= ((_ extract 0 0) (|safety_island#542| state)) #b1)))) ; _witness_.assert_flatten_output_gate__assert_output_gate_properties_vh_149_1214
(define-fun |safety_island#543| ((state |safety_island_s|)) (_ BitVec 16) (bvadd (|safety_island#205| state) #b0000000000000001)) ; $flatten\output_gate.$add$output_gate_properties.vh:15$1222_Y
(define-fun |safety_island#544| ((state |safety_island_s|)) Bool (= (|safety_island#205| state) #b1111010000100100)) ; $flatten\output_gate.$eq$output_gate_properties.vh:146$1185_Y
(define-fun |safety_island#545| ((state |safety_island_s|)) (_ BitVec 16) (ite (|safety_island#544| state) #b1111010000100100 (|safety_island#543| state))) ; $flatten\output_gate.$ternary$output_gate_properties.vh:15$1223_Y
(define-fun |safety_island#546| ((state |safety_island_s|)) Bool (= (|safety_island#204| state) (|safety_island#545| state))) ; $flatten\output_gate.$eq$output_gate_properties.vh:150$1225_Y
(define-fun |safety_island#547| ((state |safety_island_s|)) Bool (and (or  (= ((_ extract 0 0) (|safety_island#30| state)) #b1) false) (or  (|safety_island#546| state) false))) ; $flatten\output_gate.$logic_and$output_gate_properties.vh:150$1226_Y
(define-fun |safety_island#548| ((state |safety_island_s|)) Bool (distinct (|safety_island#204| state) #b0000000000000000)) ; $flatten\output_gate.$ne$output_gate_properties.vh:150$1217_Y
(define-fun |safety_island#549| ((state |safety_island_s|)) Bool (and (or  (= ((_ extract 2 2) (|safety_island#275| state)) #b1) false) (or  (|safety_island#548| state) false))) ; $flatten\output_gate.$logic_and$output_gate_properties.vh:150$1218_Y
(define-fun |safety_island#550| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#549| state) #b1 #b0)) ; $flatten\output_gate.$procmux$1975_Y
(define-fun |safety_island#551| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#23| state) #b0 (|safety_island#550| state))) ; $flatten\output_gate.$procmux$1977_Y
(define-fun |safety_island#552| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#22| state)) #b1) (|safety_island#551| state) #b0)) ; $flatten\output_gate.$assert$output_gate_properties.vh:150$1224_EN
(define-fun |safety_island_a 24| ((state |safety_island_s|)) Bool (or (|safety_island#547| state) (not (= ((_ extract 0 0) (|safety_island#552| state)) #b1)))) ; _witness_.assert_flatten_output_gate__assert_output_gate_properties_vh_150_1224
(define-fun |safety_island#553| ((state |safety_island_s|)) Bool (bvuge (|safety_island#326| state) (|safety_island#205| state))) ; $flatten\output_gate.$ge$output_gate_properties.vh:151$1228_Y
(define-fun |safety_island#554| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#30| state)) #b1) #b1 #b0)) ; $flatten\output_gate.$procmux$1966_Y
(define-fun |safety_island#555| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#23| state) #b0 (|safety_island#554| state))) ; $flatten\output_gate.$procmux$1968_Y
(define-fun |safety_island#556| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#22| state)) #b1) (|safety_island#555| state) #b0)) ; $flatten\output_gate.$assert$output_gate_properties.vh:151$1227_EN
(define-fun |safety_island_a 25| ((state |safety_island_s|)) Bool (or (|safety_island#553| state) (not (= ((_ extract 0 0) (|safety_island#556| state)) #b1)))) ; _witness_.assert_flatten_output_gate__assert_output_gate_properties_vh_151_1227
(define-fun |safety_island#557| ((state |safety_island_s|)) Bool (|safety_island_is| state)) ; $auto$rtlil.cc:3293:And$2628
(define-fun |safety_island_u 1| ((state |safety_island_s|)) Bool (or (|safety_island#6| state) (not (|safety_island#557| state)))) ; _witness_.assume_assume_safety_island_end_to_end_properties_vh_3_610
(define-fun |safety_island_u 2| ((state |safety_island_s|)) Bool (or (|safety_island#6| state) (not (|safety_island#557| state)))) ; _witness_.assume_flatten_output_gate__assume_output_gate_properties_vh_41_1231
(define-fun |safety_island#558| ((state |safety_island_s|)) (_ BitVec 16) (bvnot (concat #b0000000 (|safety_island#73| state)))) ; $not$safety_island_end_to_end_properties.vh:153$392_Y
(define-fun |safety_island#559| ((state |safety_island_s|)) (_ BitVec 16) (bvand (|safety_island#103| state) (|safety_island#558| state))) ; $and$safety_island_end_to_end_properties.vh:153$393_Y
(define-fun |safety_island#560| ((state |safety_island_s|)) Bool (not (or  (= ((_ extract 0 0) (|safety_island#559| state)) #b1) (= ((_ extract 1 1) (|safety_island#559| state)) #b1) (= ((_ extract 2 2) (|safety_island#559| state)) #b1) (= ((_ extract 3 3) (|safety_island#559| state)) #b1) (= ((_ extract 4 4) (|safety_island#559| state)) #b1) (= ((_ extract 5 5) (|safety_island#559| state)) #b1) (= ((_ extract 6 6) (|safety_island#559| state)) #b1) (= ((_ extract 7 7) (|safety_island#559| state)) #b1) (= ((_ extract 8 8) (|safety_island#559| state)) #b1) (= ((_ extract 9 9) (|safety_island#559| state)) #b1) (= ((_ extract 10 10) (|safety_island#559| state)) #b1) (= ((_ extract 11 11) (|safety_island#559| state)) #b1) (= ((_ extract 12 12) (|safety_island#559| state)) #b1) (= ((_ extract 13 13) (|safety_island#559| state)) #b1) (= ((_ extract 14 14) (|safety_island#559| state)) #b1) (= ((_ extract 15 15) (|safety_island#559| state)) #b1)))) ; $eq$safety_island_end_to_end_properties.vh:153$394_Y
(define-fun |safety_island_a 26| ((state |safety_island_s|)) Bool (or (|safety_island#560| state) (not (= ((_ extract 0 0) (|safety_island#9| state)) #b1)))) ; a_fault_is_kept
(define-fun |safety_island_a 27| ((state |safety_island_s|)) Bool (or (= ((_ extract 0 0) (|safety_island#19| state)) #b1) (not (= ((_ extract 0 0) (|safety_island#26| state)) #b1)))) ; allowed_is_linked
(define-fun |safety_island#561| ((state |safety_island_s|)) Bool (distinct (concat #b0000000 (|safety_island#73| state)) #b0000000000000000)) ; $flatten\output_gate.$ne$output_gate_properties.vh:136$1144_Y
(define-fun |safety_island#562| ((state |safety_island_s|)) Bool (= (|safety_island#42| state) (ite (|safety_island#561| state) #b1 #b0))) ; $eq$safety_island_properties.vh:46$492_Y
(define-fun |safety_island_a 28| ((state |safety_island_s|)) Bool (or (|safety_island#562| state) (not (= ((_ extract 0 0) (|safety_island#38| state)) #b1)))) ; any_fault_is_known
(define-fun |safety_island#563| ((state |safety_island_s|)) Bool (= (|safety_island#118| state) (|safety_island#51| state))) ; $eq$safety_island_end_to_end_links.vh:31$511_Y
(define-fun |safety_island_a 29| ((state |safety_island_s|)) Bool (or (|safety_island#563| state) (not (= ((_ extract 0 0) (|safety_island#52| state)) #b1)))) ; armer_is_linked
(define-fun |safety_island#564| ((state |safety_island_s|)) Bool (not (or  (= ((_ extract 0 0) (|safety_island#73| state)) #b1) (= ((_ extract 1 1) (|safety_island#73| state)) #b1) (= ((_ extract 2 2) (|safety_island#73| state)) #b1) (= ((_ extract 3 3) (|safety_island#73| state)) #b1) (= ((_ extract 4 4) (|safety_island#73| state)) #b1) (= ((_ extract 5 5) (|safety_island#73| state)) #b1) (= ((_ extract 6 6) (|safety_island#73| state)) #b1) (= ((_ extract 7 7) (|safety_island#73| state)) #b1) (= ((_ extract 8 8) (|safety_island#73| state)) #b1) false false false false false false false))) ; $eq$safety_island_end_to_end_properties.vh:152$389_Y
(define-fun |safety_island#565| ((state |safety_island_s|)) Bool (and (or  (|safety_island#40| state) false) (or  (|safety_island#564| state) false))) ; $flatten\output_gate.$logic_and$output_gate_properties.vh:34$915_Y
(define-fun |safety_island#566| ((state |safety_island_s|)) Bool (and (or  (|safety_island#565| state) false) (or  (= ((_ extract 1 1) (|safety_island#45| state)) #b1) false))) ; $flatten\output_gate.$logic_and$output_gate_properties.vh:34$916_Y
(define-fun |safety_island#567| ((state |safety_island_s|)) Bool (and (or  (|safety_island#566| state) false) (or  (= ((_ extract 1 1) (|safety_island#47| state)) #b1) false))) ; $flatten\output_gate.$logic_and$output_gate_properties.vh:34$917_Y
(define-fun |safety_island_a 30| ((state |safety_island_s|)) Bool (or (|safety_island#567| state) (not (= ((_ extract 0 0) (|safety_island#54| state)) #b1)))) ; arming_is_safe
(define-fun |safety_island#568| ((state |safety_island_s|)) Bool (bvult (|safety_island#59| state) #b00000000000000000000011000011010)) ; $lt$safety_island_end_to_end_links.vh:41$540_Y
(define-fun |safety_island#569| ((state |safety_island_s|)) (_ BitVec 32) (bvadd (|safety_island#59| state) (concat #b000000000000000000000 (|safety_island#207| state)))) ; $add$safety_island_end_to_end_links.vh:41$541_Y
(define-fun |safety_island#570| ((state |safety_island_s|)) Bool (= (|safety_island#569| state) #b00000000000000000000011000011001)) ; $eq$safety_island_end_to_end_links.vh:41$542_Y
(define-fun |safety_island#571| ((state |safety_island_s|)) Bool (and (or  (|safety_island#568| state) false) (or  (|safety_island#570| state) false))) ; $logic_and$safety_island_end_to_end_links.vh:41$543_Y
(define-fun |safety_island#572| ((state |safety_island_s|)) Bool (= (|safety_island#207| state) #b11000011001)) ; $eq$safety_island_end_to_end_links.vh:40$539_Y
(define-fun |safety_island#573| ((state |safety_island_s|)) Bool (= (|safety_island#59| state) #b00000000000000000000011000011010)) ; $eq$safety_island_end_to_end_links.vh:40$538_Y
(define-fun |safety_island#574| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#573| state) (ite (|safety_island#572| state) #b1 #b0) (ite (|safety_island#571| state) #b1 #b0))) ; $ternary$safety_island_end_to_end_links.vh:40$544_Y
(define-fun |safety_island_a 31| ((state |safety_island_s|)) Bool (or (= ((_ extract 0 0) (|safety_island#574| state)) #b1) (not (= ((_ extract 0 0) (|safety_island#62| state)) #b1)))) ; beat_is_linked
(define-fun |safety_island#575| ((state |safety_island_s|)) Bool (or  (|safety_island#24| state) false  (|safety_island#6| state) false)) ; $flatten\output_gate.$logic_or$output_gate_properties.vh:38$920_Y
(define-fun |safety_island_u 3| ((state |safety_island_s|)) Bool (or (|safety_island#575| state) (not true))) ; clock_is_lost_in_reset
(define-fun |safety_island#576| ((state |safety_island_s|)) Bool (bvule (|safety_island#83| state) #b00100110011001101)) ; $le$safety_island_properties.vh:38$462_Y
(define-fun |safety_island#577| ((state |safety_island_s|)) Bool (bvule (|safety_island#85| state) #b101101110001101100000)) ; $le$safety_island_properties.vh:38$463_Y
(define-fun |safety_island#578| ((state |safety_island_s|)) Bool (and (or  (|safety_island#576| state) false) (or  (|safety_island#577| state) false))) ; $logic_and$safety_island_properties.vh:38$464_Y
(define-fun |safety_island_a 32| ((state |safety_island_s|)) Bool (or (|safety_island#578| state) (not (= ((_ extract 0 0) (|safety_island#38| state)) #b1)))) ; duty_is_clamped
(define-fun |safety_island#579| ((state |safety_island_s|)) Bool (bvsle (|safety_island#327| state) (concat #b0 (|safety_island#80| state)))) ; $le$safety_island_end_to_end_links.vh:55$596_Y
(define-fun |safety_island_a 33| ((state |safety_island_s|)) Bool (or (|safety_island#579| state) (not (= ((_ extract 0 0) (|safety_island#52| state)) #b1)))) ; duty_is_linked
(define-fun |safety_island#580| ((state |safety_island_s|)) Bool (not (or  (= ((_ extract 0 0) (|safety_island#108| state)) #b1) false))) ; $logic_not$safety_island_end_to_end_properties.vh:156$401_Y
(define-fun |safety_island#581| ((state |safety_island_s|)) Bool (and (or  (= ((_ extract 0 0) (|safety_island#42| state)) #b1) false) (or  (|safety_island#580| state) false))) ; $logic_and$safety_island_end_to_end_properties.vh:156$402_Y
(define-fun |safety_island#582| ((state |safety_island_s|)) Bool (not (or  (= ((_ extract 0 0) (|safety_island#3| state)) #b1) false))) ; $logic_not$safety_island_end_to_end_properties.vh:156$403_Y
(define-fun |safety_island#583| ((state |safety_island_s|)) Bool (and (or  (|safety_island#581| state) false) (or  (|safety_island#582| state) false))) ; $logic_and$safety_island_end_to_end_properties.vh:156$404_Y
(define-fun |safety_island#584| ((state |safety_island_s|)) (_ BitVec 32) (bvadd (|safety_island#105| state) (concat #b0000000000000000000000000000000 (ite (|safety_island#583| state) #b1 #b0)))) ; $add$safety_island_end_to_end_properties.vh:156$405_Y
(define-fun |safety_island#585| ((state |safety_island_s|)) Bool (= (|safety_island#106| state) (|safety_island#584| state))) ; $eq$safety_island_end_to_end_properties.vh:156$406_Y
(define-fun |safety_island#586| ((state |safety_island_s|)) Bool (or  (|safety_island#585| state) false  (= ((_ extract 0 0) (|safety_island#3| state)) #b1) false)) ; $logic_or$safety_island_end_to_end_properties.vh:156$407_Y
(define-fun |safety_island_a 34| ((state |safety_island_s|)) Bool (or (|safety_island#586| state) (not (= ((_ extract 0 0) (|safety_island#87| state)) #b1)))) ; each_fault_counts
(define-fun |safety_island#587| ((state |safety_island_s|)) Bool (bvule (|safety_island#66| state) #b11001111000010)) ; $le$safety_island_properties.vh:35$457_Y
(define-fun |safety_island#588| ((state |safety_island_s|)) Bool (bvule (|safety_island#419| state) #b1011011100011011000)) ; $le$safety_island_properties.vh:35$458_Y
(define-fun |safety_island#589| ((state |safety_island_s|)) Bool (and (or  (|safety_island#587| state) false) (or  (|safety_island#588| state) false))) ; $logic_and$safety_island_properties.vh:35$459_Y
(define-fun |safety_island_a 35| ((state |safety_island_s|)) Bool (or (|safety_island#589| state) (not (= ((_ extract 0 0) (|safety_island#38| state)) #b1)))) ; edges_are_clamped
(define-fun |safety_island#590| ((state |safety_island_s|)) Bool (= (concat #b000000000000000000 (|safety_island#66| state)) (|safety_island#94| state))) ; $eq$safety_island_end_to_end_links.vh:34$521_Y
(define-fun |safety_island#591| ((state |safety_island_s|)) Bool (= (concat #b0000000000000 (|safety_island#419| state)) (|safety_island#425| state))) ; $eq$safety_island_end_to_end_links.vh:34$523_Y
(define-fun |safety_island#592| ((state |safety_island_s|)) Bool (and (or  (|safety_island#590| state) false) (or  (|safety_island#591| state) false))) ; $logic_and$safety_island_end_to_end_links.vh:46$562_Y
(define-fun |safety_island_a 36| ((state |safety_island_s|)) Bool (or (|safety_island#592| state) (not (= ((_ extract 0 0) (|safety_island#52| state)) #b1)))) ; edges_are_of_the_pins
(define-fun |safety_island#593| ((state |safety_island_s|)) Bool (bvule (|safety_island#98| state) #b100000000010110010)) ; $le$safety_island_properties.vh:37$461_Y
(define-fun |safety_island_a 37| ((state |safety_island_s|)) Bool (or (|safety_island#593| state) (not (= ((_ extract 0 0) (|safety_island#38| state)) #b1)))) ; emission_is_clamped
(define-fun |safety_island#594| ((state |safety_island_s|)) Bool (bvule (|safety_island#351| state) (concat #b0 (|safety_island#357| state)))) ; $le$safety_island_end_to_end_links.vh:53$589_Y
(define-fun |safety_island#595| ((state |safety_island_s|)) Bool (bvuge (concat #b00000000000000 (|safety_island#357| state)) (|safety_island#96| state))) ; $ge$safety_island_end_to_end_links.vh:53$590_Y
(define-fun |safety_island#596| ((state |safety_island_s|)) Bool (or  (|safety_island#594| state) false  (|safety_island#595| state) false)) ; $logic_or$safety_island_end_to_end_links.vh:53$591_Y
(define-fun |safety_island_a 38| ((state |safety_island_s|)) Bool (or (|safety_island#596| state) (not (= ((_ extract 0 0) (|safety_island#100| state)) #b1)))) ; emissions_are_linked
(define-fun |safety_island#597| ((state |safety_island_s|)) Bool (bvule (|safety_island#124| state) #b10111110101111000010000)) ; $le$safety_island_properties.vh:34$456_Y
(define-fun |safety_island_a 39| ((state |safety_island_s|)) Bool (or (|safety_island#597| state) (not (= ((_ extract 0 0) (|safety_island#38| state)) #b1)))) ; heartbeat_is_clamped
(define-fun |safety_island_a 40| ((state |safety_island_s|)) Bool (or (= ((_ extract 2 2) (|safety_island#73| state)) #b1) (not (= ((_ extract 0 0) (|safety_island#130| state)) #b1)))) ; heat_is_a_fault
(define-fun |safety_island#598| ((state |safety_island_s|)) Bool (= ((_ extract 1 1) (|safety_island#47| state)) (|safety_island#57| state))) ; $eq$safety_island_end_to_end_properties.vh:138$363_Y
(define-fun |safety_island_a 41| ((state |safety_island_s|)) Bool (or (|safety_island#598| state) (not (= ((_ extract 0 0) (|safety_island#79| state)) #b1)))) ; heat_is_its_pin
(define-fun |safety_island#599| ((state |safety_island_s|)) Bool (not (or  (|safety_island#37| state) false))) ; $flatten\output_gate.$logic_not$output_gate_properties.vh:87$1022_Y
(define-fun |safety_island_a 42| ((state |safety_island_s|)) Bool (or (|safety_island#599| state) (not (= ((_ extract 0 0) (|safety_island#132| state)) #b1)))) ; heat_pin_is_off
(define-fun |safety_island_a 43| ((state |safety_island_s|)) Bool (or (= ((_ extract 0 0) (|safety_island#33| state)) #b1) (not (= ((_ extract 0 0) (|safety_island#139| state)) #b1)))) ; life_begins
(define-fun |safety_island#600| ((state |safety_island_s|)) Bool (distinct (|safety_island#33| state) (|safety_island#16| state))) ; $ne$safety_island_end_to_end_properties.vh:129$347_Y
(define-fun |safety_island#601| ((state |safety_island_s|)) Bool (= (ite (|safety_island#600| state) #b1 #b0) (ite (|safety_island#573| state) #b1 #b0))) ; $eq$safety_island_end_to_end_properties.vh:147$383_Y
(define-fun |safety_island_a 44| ((state |safety_island_s|)) Bool (or (|safety_island#601| state) (not (= ((_ extract 0 0) (|safety_island#142| state)) #b1)))) ; life_has_its_rate
(define-fun |safety_island#602| ((state |safety_island_s|)) Bool (= (|safety_island#66| state) (|safety_island#93| state))) ; $eq$safety_island_properties.vh:41$471_Y
(define-fun |safety_island#603| ((state |safety_island_s|)) Bool (= (|safety_island#419| state) (|safety_island#424| state))) ; $eq$safety_island_properties.vh:41$473_Y
(define-fun |safety_island#604| ((state |safety_island_s|)) Bool (and (or  (|safety_island#602| state) false) (or  (|safety_island#603| state) false))) ; $logic_and$safety_island_properties.vh:45$490_Y
(define-fun |safety_island_a 45| ((state |safety_island_s|)) Bool (or (|safety_island#604| state) (not (= ((_ extract 0 0) (|safety_island#153| state)) #b1)))) ; limits_of_edges_rest
(define-fun |safety_island#605| ((state |safety_island_s|)) Bool (= (|safety_island#124| state) (|safety_island#122| state))) ; $eq$safety_island_properties.vh:41$470_Y
(define-fun |safety_island#606| ((state |safety_island_s|)) Bool (and (or  (|safety_island#605| state) false) (or  (|safety_island#602| state) false))) ; $logic_and$safety_island_properties.vh:41$472_Y
(define-fun |safety_island#607| ((state |safety_island_s|)) Bool (and (or  (|safety_island#606| state) false) (or  (|safety_island#603| state) false))) ; $logic_and$safety_island_properties.vh:41$474_Y
(define-fun |safety_island#608| ((state |safety_island_s|)) Bool (= (|safety_island#98| state) (|safety_island#95| state))) ; $eq$safety_island_properties.vh:42$475_Y
(define-fun |safety_island#609| ((state |safety_island_s|)) Bool (and (or  (|safety_island#607| state) false) (or  (|safety_island#608| state) false))) ; $logic_and$safety_island_properties.vh:41$476_Y
(define-fun |safety_island#610| ((state |safety_island_s|)) Bool (= (|safety_island#85| state) (|safety_island#78| state))) ; $eq$safety_island_properties.vh:42$477_Y
(define-fun |safety_island#611| ((state |safety_island_s|)) Bool (and (or  (|safety_island#609| state) false) (or  (|safety_island#610| state) false))) ; $logic_and$safety_island_properties.vh:41$478_Y
(define-fun |safety_island#612| ((state |safety_island_s|)) Bool (= (|safety_island#336| state) (|safety_island#333| state))) ; $eq$safety_island_properties.vh:42$479_Y
(define-fun |safety_island#613| ((state |safety_island_s|)) Bool (and (or  (|safety_island#611| state) false) (or  (|safety_island#612| state) false))) ; $logic_and$safety_island_properties.vh:41$480_Y
(define-fun |safety_island#614| ((state |safety_island_s|)) Bool (= (|safety_island#83| state) (|safety_island#342| state))) ; $eq$safety_island_properties.vh:43$481_Y
(define-fun |safety_island#615| ((state |safety_island_s|)) Bool (and (or  (|safety_island#613| state) false) (or  (|safety_island#614| state) false))) ; $logic_and$safety_island_properties.vh:41$482_Y
(define-fun |safety_island#616| ((state |safety_island_s|)) Bool (= (|safety_island#118| state) (|safety_island#159| state))) ; $eq$safety_island_properties.vh:43$483_Y
(define-fun |safety_island#617| ((state |safety_island_s|)) Bool (and (or  (|safety_island#615| state) false) (or  (|safety_island#616| state) false))) ; $logic_and$safety_island_properties.vh:41$484_Y
(define-fun |safety_island_a 46| ((state |safety_island_s|)) Bool (or (|safety_island#617| state) (not (= ((_ extract 0 0) (|safety_island#158| state)) #b1)))) ; limits_rest
(define-fun |safety_island_a 47| ((state |safety_island_s|)) Bool (or (|safety_island#599| state) (not (= ((_ extract 0 0) (|safety_island#161| state)) #b1)))) ; long_emission_is_off
(define-fun |safety_island_a 48| ((state |safety_island_s|)) Bool (or (= ((_ extract 0 0) (|safety_island#73| state)) #b1) (not (= ((_ extract 0 0) (|safety_island#166| state)) #b1)))) ; lost_permit_is_a_fault
(define-fun |safety_island_a 49| ((state |safety_island_s|)) Bool (or (|safety_island#599| state) (not (= ((_ extract 0 0) (|safety_island#178| state)) #b1)))) ; much_duty_is_off
(define-fun |safety_island_a 50| ((state |safety_island_s|)) Bool (or (|safety_island#599| state) (not (= ((_ extract 0 0) (|safety_island#179| state)) #b1)))) ; no_clock_is_off
(define-fun |safety_island#618| ((state |safety_island_s|)) Bool (not (or  (= ((_ extract 0 0) (|safety_island#33| state)) #b1) false))) ; $flatten\output_gate.$logic_not$output_gate_properties.vh:125$1103_Y
(define-fun |safety_island#619| ((state |safety_island_s|)) Bool (not (or  (= ((_ extract 0 0) (|safety_island#36| state)) #b1) false))) ; $flatten\output_gate.$logic_not$output_gate_properties.vh:125$1104_Y
(define-fun |safety_island#620| ((state |safety_island_s|)) Bool (and (or  (|safety_island#618| state) false) (or  (|safety_island#619| state) false))) ; $flatten\output_gate.$logic_and$output_gate_properties.vh:125$1105_Y
(define-fun |safety_island_a 51| ((state |safety_island_s|)) Bool (or (|safety_island#620| state) (not (= ((_ extract 0 0) (|safety_island#181| state)) #b1)))) ; no_life_when_off
(define-fun |safety_island_a 52| ((state |safety_island_s|)) Bool (or true (not (= ((_ extract 0 0) (|safety_island#38| state)) #b1)))) ; no_stage_no_move
(define-fun |safety_island_a 53| ((state |safety_island_s|)) Bool (or (|safety_island#599| state) (not (= ((_ extract 0 0) (|safety_island#185| state)) #b1)))) ; off_is_off
(define-fun |safety_island_a 54| ((state |safety_island_s|)) Bool (or (= ((_ extract 0 0) (|safety_island#19| state)) #b1) (not (= ((_ extract 0 0) (|safety_island#187| state)) #b1)))) ; on_while_allowed
(define-fun |safety_island#621| ((state |safety_island_s|)) Bool (and (or  (|safety_island#43| state) false) (or  (|safety_island#564| state) false))) ; $logic_and$safety_island_end_to_end_properties.vh:152$390_Y
(define-fun |safety_island_a 55| ((state |safety_island_s|)) Bool (or (|safety_island#621| state) (not (= ((_ extract 0 0) (|safety_island#187| state)) #b1)))) ; on_without_fault
(define-fun |safety_island#622| ((state |safety_island_s|)) Bool (and (or  (|safety_island#109| state) false) (or  (|safety_island#119| state) false))) ; $logic_and$safety_island_properties.vh:47$494_Y
(define-fun |safety_island#623| ((state |safety_island_s|)) Bool (or  (|safety_island#39| state) false  (|safety_island#622| state) false)) ; $logic_or$safety_island_properties.vh:47$495_Y
(define-fun |safety_island_a 56| ((state |safety_island_s|)) Bool (or (|safety_island#623| state) (not (= ((_ extract 0 0) (|safety_island#189| state)) #b1)))) ; one_link_feeds
(define-fun |safety_island#624| ((state |safety_island_s|)) (_ BitVec 33) (bvadd (concat #b0 (|safety_island#338| state)) #b000000000000000000000000000000001)) ; $add$safety_island_end_to_end_properties.vh:150$384_Y
(define-fun |safety_island#625| ((state |safety_island_s|)) Bool (bvule (concat #b0 (|safety_island#337| state)) (|safety_island#624| state))) ; $le$safety_island_end_to_end_properties.vh:150$385_Y
(define-fun |safety_island#626| ((state |safety_island_s|)) Bool (bvule (|safety_island#337| state) #b00000000000000000000000000000010)) ; $le$safety_island_end_to_end_properties.vh:150$386_Y
(define-fun |safety_island#627| ((state |safety_island_s|)) Bool (or  (|safety_island#625| state) false  (|safety_island#626| state) false)) ; $logic_or$safety_island_end_to_end_properties.vh:150$387_Y
(define-fun |safety_island_a 57| ((state |safety_island_s|)) Bool (or (|safety_island#627| state) (not (= ((_ extract 0 0) (|safety_island#187| state)) #b1)))) ; only_the_armer_feeds
(define-fun |safety_island#628| ((state |safety_island_s|)) (_ BitVec 32) (bvand (|safety_island#168| state) (|safety_island#76| state))) ; $and$safety_island_end_to_end_properties.vh:142$368_Y
(define-fun |safety_island#629| ((state |safety_island_s|)) (_ BitVec 32) (bvnot (|safety_island#628| state))) ; $not$safety_island_end_to_end_properties.vh:142$369_Y
(define-fun |safety_island#630| ((state |safety_island_s|)) (_ BitVec 32) (bvand (|safety_island#27| state) (|safety_island#629| state))) ; $and$safety_island_end_to_end_properties.vh:142$370_Y
(define-fun |safety_island#631| ((state |safety_island_s|)) Bool (not (or  (= ((_ extract 0 0) (|safety_island#630| state)) #b1) (= ((_ extract 1 1) (|safety_island#630| state)) #b1) (= ((_ extract 2 2) (|safety_island#630| state)) #b1) (= ((_ extract 3 3) (|safety_island#630| state)) #b1) (= ((_ extract 4 4) (|safety_island#630| state)) #b1) (= ((_ extract 5 5) (|safety_island#630| state)) #b1) (= ((_ extract 6 6) (|safety_island#630| state)) #b1) (= ((_ extract 7 7) (|safety_island#630| state)) #b1) (= ((_ extract 8 8) (|safety_island#630| state)) #b1) (= ((_ extract 9 9) (|safety_island#630| state)) #b1) (= ((_ extract 10 10) (|safety_island#630| state)) #b1) (= ((_ extract 11 11) (|safety_island#630| state)) #b1) (= ((_ extract 12 12) (|safety_island#630| state)) #b1) (= ((_ extract 13 13) (|safety_island#630| state)) #b1) (= ((_ extract 14 14) (|safety_island#630| state)) #b1) (= ((_ extract 15 15) (|safety_island#630| state)) #b1) (= ((_ extract 16 16) (|safety_island#630| state)) #b1) (= ((_ extract 17 17) (|safety_island#630| state)) #b1) (= ((_ extract 18 18) (|safety_island#630| state)) #b1) (= ((_ extract 19 19) (|safety_island#630| state)) #b1) (= ((_ extract 20 20) (|safety_island#630| state)) #b1) (= ((_ extract 21 21) (|safety_island#630| state)) #b1) (= ((_ extract 22 22) (|safety_island#630| state)) #b1) (= ((_ extract 23 23) (|safety_island#630| state)) #b1) (= ((_ extract 24 24) (|safety_island#630| state)) #b1) (= ((_ extract 25 25) (|safety_island#630| state)) #b1) (= ((_ extract 26 26) (|safety_island#630| state)) #b1) (= ((_ extract 27 27) (|safety_island#630| state)) #b1) (= ((_ extract 28 28) (|safety_island#630| state)) #b1) (= ((_ extract 29 29) (|safety_island#630| state)) #b1) (= ((_ extract 30 30) (|safety_island#630| state)) #b1) (= ((_ extract 31 31) (|safety_island#630| state)) #b1)))) ; $eq$safety_island_end_to_end_properties.vh:142$371_Y
(define-fun |safety_island_a 58| ((state |safety_island_s|)) Bool (or (|safety_island#631| state) (not (= ((_ extract 0 0) (|safety_island#79| state)) #b1)))) ; only_what_may_move
(define-fun |safety_island#632| ((state |safety_island_s|)) (_ BitVec 32) (bvadd (|safety_island#251| state) #b00000000000000000000000000000001)) ; $flatten\output_gate.$add$output_gate_properties.vh:110$1065_Y
(define-fun |safety_island#633| ((state |safety_island_s|)) Bool (= (|safety_island#106| state) (|safety_island#632| state))) ; $flatten\output_gate.$eq$output_gate_properties.vh:110$1066_Y
(define-fun |safety_island#634| ((state |safety_island_s|)) Bool (= (|safety_island#107| state) (|safety_island#274| state))) ; $flatten\output_gate.$eq$output_gate_properties.vh:110$1067_Y
(define-fun |safety_island#635| ((state |safety_island_s|)) Bool (and (or  (|safety_island#633| state) false) (or  (|safety_island#634| state) false))) ; $flatten\output_gate.$logic_and$output_gate_properties.vh:110$1068_Y
(define-fun |safety_island_a 59| ((state |safety_island_s|)) Bool (or (|safety_island#635| state) (not (= ((_ extract 0 0) (|safety_island#197| state)) #b1)))) ; output_gate.a_fault_is_counted
(define-fun |safety_island#636| ((state |safety_island_s|)) Bool (distinct ((_ extract 8 4) (|safety_island#73| state)) #b00000)) ; $flatten\output_gate.$ne$output_gate_properties.vh:121$1094_Y
(define-fun |safety_island_a 60| ((state |safety_island_s|)) Bool (or (|safety_island#636| state) (not (= ((_ extract 0 0) (|safety_island#201| state)) #b1)))) ; output_gate.a_limit_rests
(define-fun |safety_island_a 61| ((state |safety_island_s|)) Bool (or (|safety_island#562| state) (not (= ((_ extract 0 0) (|safety_island#210| state)) #b1)))) ; output_gate.any_is_known
(define-fun |safety_island#637| ((state |safety_island_s|)) Bool (and (or  (|safety_island#567| state) false) (or  (|safety_island#121| state) false))) ; $flatten\output_gate.$logic_and$output_gate_properties.vh:34$918_Y
(define-fun |safety_island_a 62| ((state |safety_island_s|)) Bool (or (|safety_island#637| state) (not (= ((_ extract 0 0) (|safety_island#213| state)) #b1)))) ; output_gate.arm_is_as_taken
(define-fun |safety_island_a 63| ((state |safety_island_s|)) Bool (or (|safety_island#599| state) (not (= ((_ extract 0 0) (|safety_island#217| state)) #b1)))) ; output_gate.beyond_is_off
(define-fun |safety_island_u 4| ((state |safety_island_s|)) Bool (or (|safety_island#575| state) (not true))) ; output_gate.clock_is_lost_in_reset
(define-fun |safety_island#638| ((state |safety_island_s|)) Bool (= (|safety_island#106| state) (|safety_island#251| state))) ; $flatten\output_gate.$eq$output_gate_properties.vh:111$1069_Y
(define-fun |safety_island_a 64| ((state |safety_island_s|)) Bool (or (|safety_island#638| state) (not (= ((_ extract 0 0) (|safety_island#226| state)) #b1)))) ; output_gate.counted_once
(define-fun |safety_island#639| ((state |safety_island_s|)) Bool (or  (|safety_island#40| state) false  (|safety_island#245| state) false)) ; $flatten\output_gate.$logic_or$output_gate_properties.vh:113$1079_Y
(define-fun |safety_island#640| ((state |safety_island_s|)) Bool (or  (|safety_island#639| state) false  (|safety_island#14| state) false)) ; $flatten\output_gate.$logic_or$output_gate_properties.vh:113$1081_Y
(define-fun |safety_island_a 65| ((state |safety_island_s|)) Bool (or (|safety_island#640| state) (not (= ((_ extract 0 0) (|safety_island#232| state)) #b1)))) ; output_gate.disarm_is_obeyed
(define-fun |safety_island_a 66| ((state |safety_island_s|)) Bool (or (|safety_island#640| state) (not (= ((_ extract 0 0) (|safety_island#235| state)) #b1)))) ; output_gate.disarmed_for_good
(define-fun |safety_island#641| ((state |safety_island_s|)) (_ BitVec 32) (bvnot (concat #b000000000000000000000000000 ((_ extract 8 4) (|safety_island#73| state))))) ; $flatten\output_gate.$not$output_gate_properties.vh:103$1050_Y
(define-fun |safety_island#642| ((state |safety_island_s|)) (_ BitVec 32) (bvand (concat #b000000000000000000000000000 (|safety_island#237| state)) (|safety_island#641| state))) ; $flatten\output_gate.$and$output_gate_properties.vh:109$1061_Y
(define-fun |safety_island#643| ((state |safety_island_s|)) Bool (not (or  (= ((_ extract 0 0) (|safety_island#642| state)) #b1) (= ((_ extract 1 1) (|safety_island#642| state)) #b1) (= ((_ extract 2 2) (|safety_island#642| state)) #b1) (= ((_ extract 3 3) (|safety_island#642| state)) #b1) (= ((_ extract 4 4) (|safety_island#642| state)) #b1) (= ((_ extract 5 5) (|safety_island#642| state)) #b1) (= ((_ extract 6 6) (|safety_island#642| state)) #b1) (= ((_ extract 7 7) (|safety_island#642| state)) #b1) (= ((_ extract 8 8) (|safety_island#642| state)) #b1) (= ((_ extract 9 9) (|safety_island#642| state)) #b1) (= ((_ extract 10 10) (|safety_island#642| state)) #b1) (= ((_ extract 11 11) (|safety_island#642| state)) #b1) (= ((_ extract 12 12) (|safety_island#642| state)) #b1) (= ((_ extract 13 13) (|safety_island#642| state)) #b1) (= ((_ extract 14 14) (|safety_island#642| state)) #b1) (= ((_ extract 15 15) (|safety_island#642| state)) #b1) (= ((_ extract 16 16) (|safety_island#642| state)) #b1) (= ((_ extract 17 17) (|safety_island#642| state)) #b1) (= ((_ extract 18 18) (|safety_island#642| state)) #b1) (= ((_ extract 19 19) (|safety_island#642| state)) #b1) (= ((_ extract 20 20) (|safety_island#642| state)) #b1) (= ((_ extract 21 21) (|safety_island#642| state)) #b1) (= ((_ extract 22 22) (|safety_island#642| state)) #b1) (= ((_ extract 23 23) (|safety_island#642| state)) #b1) (= ((_ extract 24 24) (|safety_island#642| state)) #b1) (= ((_ extract 25 25) (|safety_island#642| state)) #b1) (= ((_ extract 26 26) (|safety_island#642| state)) #b1) (= ((_ extract 27 27) (|safety_island#642| state)) #b1) (= ((_ extract 28 28) (|safety_island#642| state)) #b1) (= ((_ extract 29 29) (|safety_island#642| state)) #b1) (= ((_ extract 30 30) (|safety_island#642| state)) #b1) (= ((_ extract 31 31) (|safety_island#642| state)) #b1)))) ; $flatten\output_gate.$eq$output_gate_properties.vh:109$1062_Y
(define-fun |safety_island_a 67| ((state |safety_island_s|)) Bool (or (|safety_island#643| state) (not (= ((_ extract 0 0) (|safety_island#239| state)) #b1)))) ; output_gate.edges_are_kept
(define-fun |safety_island#644| ((state |safety_island_s|)) Bool (and (or  (= ((_ extract 0 0) (|safety_island#30| state)) #b1) false) (or  (|safety_island#544| state) false))) ; $flatten\output_gate.$logic_and$output_gate_properties.vh:146$1186_Y
(define-fun |safety_island_a 68| ((state |safety_island_s|)) Bool (or (|safety_island#644| state) (not (= ((_ extract 0 0) (|safety_island#242| state)) #b1)))) ; output_gate.edges_once_settled
(define-fun |safety_island_a 69| ((state |safety_island_s|)) Bool (or (= ((_ extract 2 2) (|safety_island#73| state)) #b1) (not (= ((_ extract 0 0) (|safety_island#261| state)) #b1)))) ; output_gate.heat_is_kept
(define-fun |safety_island_a 70| ((state |safety_island_s|)) Bool (or (|safety_island#599| state) (not (= ((_ extract 0 0) (|safety_island#262| state)) #b1)))) ; output_gate.hot_is_off
(define-fun |safety_island#645| ((state |safety_island_s|)) (_ BitVec 32) (bvand (concat #b000000000000000000000000000 (|safety_island#214| state)) (|safety_island#641| state))) ; $flatten\output_gate.$and$output_gate_properties.vh:103$1051_Y
(define-fun |safety_island#646| ((state |safety_island_s|)) Bool (not (or  (= ((_ extract 0 0) (|safety_island#645| state)) #b1) (= ((_ extract 1 1) (|safety_island#645| state)) #b1) (= ((_ extract 2 2) (|safety_island#645| state)) #b1) (= ((_ extract 3 3) (|safety_island#645| state)) #b1) (= ((_ extract 4 4) (|safety_island#645| state)) #b1) (= ((_ extract 5 5) (|safety_island#645| state)) #b1) (= ((_ extract 6 6) (|safety_island#645| state)) #b1) (= ((_ extract 7 7) (|safety_island#645| state)) #b1) (= ((_ extract 8 8) (|safety_island#645| state)) #b1) (= ((_ extract 9 9) (|safety_island#645| state)) #b1) (= ((_ extract 10 10) (|safety_island#645| state)) #b1) (= ((_ extract 11 11) (|safety_island#645| state)) #b1) (= ((_ extract 12 12) (|safety_island#645| state)) #b1) (= ((_ extract 13 13) (|safety_island#645| state)) #b1) (= ((_ extract 14 14) (|safety_island#645| state)) #b1) (= ((_ extract 15 15) (|safety_island#645| state)) #b1) (= ((_ extract 16 16) (|safety_island#645| state)) #b1) (= ((_ extract 17 17) (|safety_island#645| state)) #b1) (= ((_ extract 18 18) (|safety_island#645| state)) #b1) (= ((_ extract 19 19) (|safety_island#645| state)) #b1) (= ((_ extract 20 20) (|safety_island#645| state)) #b1) (= ((_ extract 21 21) (|safety_island#645| state)) #b1) (= ((_ extract 22 22) (|safety_island#645| state)) #b1) (= ((_ extract 23 23) (|safety_island#645| state)) #b1) (= ((_ extract 24 24) (|safety_island#645| state)) #b1) (= ((_ extract 25 25) (|safety_island#645| state)) #b1) (= ((_ extract 26 26) (|safety_island#645| state)) #b1) (= ((_ extract 27 27) (|safety_island#645| state)) #b1) (= ((_ extract 28 28) (|safety_island#645| state)) #b1) (= ((_ extract 29 29) (|safety_island#645| state)) #b1) (= ((_ extract 30 30) (|safety_island#645| state)) #b1) (= ((_ extract 31 31) (|safety_island#645| state)) #b1)))) ; $flatten\output_gate.$eq$output_gate_properties.vh:103$1052_Y
(define-fun |safety_island_a 71| ((state |safety_island_s|)) Bool (or (|safety_island#646| state) (not (= ((_ extract 0 0) (|safety_island#264| state)) #b1)))) ; output_gate.limits_are_kept
(define-fun |safety_island#647| ((state |safety_island_s|)) Bool (distinct (|safety_island#275| state) #b000)) ; $flatten\output_gate.$ne$output_gate.v:138$874_Y
(define-fun |safety_island#648| ((state |safety_island_s|)) Bool (or  (|safety_island#248| state) false  (|safety_island#647| state) false)) ; $flatten\output_gate.$logic_or$output_gate.v:138$875_Y
(define-fun |safety_island#649| ((state |safety_island_s|)) Bool (or  (|safety_island#648| state) false  (= ((_ extract 0 0) (|safety_island#30| state)) #b1) false)) ; $flatten\output_gate.$logic_or$output_gate_properties.vh:134$1139_Y
(define-fun |safety_island#650| ((state |safety_island_s|)) Bool (= (|safety_island#20| state) (ite (|safety_island#649| state) #b1 #b0))) ; $flatten\output_gate.$eq$output_gate_properties.vh:134$1140_Y
(define-fun |safety_island_a 72| ((state |safety_island_s|)) Bool (or (|safety_island#650| state) (not (= ((_ extract 0 0) (|safety_island#210| state)) #b1)))) ; output_gate.live_is_anything_on
(define-fun |safety_island#651| ((state |safety_island_s|)) (_ BitVec 32) (bvnot (|safety_island#267| state))) ; $flatten\output_gate.$not$output_gate_properties.vh:95$1039_Y
(define-fun |safety_island#652| ((state |safety_island_s|)) (_ BitVec 32) (bvand (|safety_island#27| state) (|safety_island#651| state))) ; $flatten\output_gate.$and$output_gate_properties.vh:95$1040_Y
(define-fun |safety_island#653| ((state |safety_island_s|)) Bool (not (or  (= ((_ extract 0 0) (|safety_island#652| state)) #b1) (= ((_ extract 1 1) (|safety_island#652| state)) #b1) (= ((_ extract 2 2) (|safety_island#652| state)) #b1) (= ((_ extract 3 3) (|safety_island#652| state)) #b1) (= ((_ extract 4 4) (|safety_island#652| state)) #b1) (= ((_ extract 5 5) (|safety_island#652| state)) #b1) (= ((_ extract 6 6) (|safety_island#652| state)) #b1) (= ((_ extract 7 7) (|safety_island#652| state)) #b1) (= ((_ extract 8 8) (|safety_island#652| state)) #b1) (= ((_ extract 9 9) (|safety_island#652| state)) #b1) (= ((_ extract 10 10) (|safety_island#652| state)) #b1) (= ((_ extract 11 11) (|safety_island#652| state)) #b1) (= ((_ extract 12 12) (|safety_island#652| state)) #b1) (= ((_ extract 13 13) (|safety_island#652| state)) #b1) (= ((_ extract 14 14) (|safety_island#652| state)) #b1) (= ((_ extract 15 15) (|safety_island#652| state)) #b1) (= ((_ extract 16 16) (|safety_island#652| state)) #b1) (= ((_ extract 17 17) (|safety_island#652| state)) #b1) (= ((_ extract 18 18) (|safety_island#652| state)) #b1) (= ((_ extract 19 19) (|safety_island#652| state)) #b1) (= ((_ extract 20 20) (|safety_island#652| state)) #b1) (= ((_ extract 21 21) (|safety_island#652| state)) #b1) (= ((_ extract 22 22) (|safety_island#652| state)) #b1) (= ((_ extract 23 23) (|safety_island#652| state)) #b1) (= ((_ extract 24 24) (|safety_island#652| state)) #b1) (= ((_ extract 25 25) (|safety_island#652| state)) #b1) (= ((_ extract 26 26) (|safety_island#652| state)) #b1) (= ((_ extract 27 27) (|safety_island#652| state)) #b1) (= ((_ extract 28 28) (|safety_island#652| state)) #b1) (= ((_ extract 29 29) (|safety_island#652| state)) #b1) (= ((_ extract 30 30) (|safety_island#652| state)) #b1) (= ((_ extract 31 31) (|safety_island#652| state)) #b1)))) ; $flatten\output_gate.$eq$output_gate_properties.vh:95$1041_Y
(define-fun |safety_island_a 73| ((state |safety_island_s|)) Bool (or (|safety_island#653| state) (not (= ((_ extract 0 0) (|safety_island#38| state)) #b1)))) ; output_gate.mask_is_kept
(define-fun |safety_island#654| ((state |safety_island_s|)) Bool (= (|safety_island#206| state) #b1111010000100100)) ; $flatten\output_gate.$eq$output_gate_properties.vh:142$1174_Y
(define-fun |safety_island_a 74| ((state |safety_island_s|)) Bool (or (|safety_island#654| state) (not (= ((_ extract 0 0) (|safety_island#271| state)) #b1)))) ; output_gate.moves_once_settled
(define-fun |safety_island#655| ((state |safety_island_s|)) Bool (not (or  (= ((_ extract 0 0) (|safety_island#27| state)) #b1) (= ((_ extract 1 1) (|safety_island#27| state)) #b1) (= ((_ extract 2 2) (|safety_island#27| state)) #b1) (= ((_ extract 3 3) (|safety_island#27| state)) #b1) (= ((_ extract 4 4) (|safety_island#27| state)) #b1) (= ((_ extract 5 5) (|safety_island#27| state)) #b1) (= ((_ extract 6 6) (|safety_island#27| state)) #b1) (= ((_ extract 7 7) (|safety_island#27| state)) #b1) (= ((_ extract 8 8) (|safety_island#27| state)) #b1) (= ((_ extract 9 9) (|safety_island#27| state)) #b1) (= ((_ extract 10 10) (|safety_island#27| state)) #b1) (= ((_ extract 11 11) (|safety_island#27| state)) #b1) (= ((_ extract 12 12) (|safety_island#27| state)) #b1) (= ((_ extract 13 13) (|safety_island#27| state)) #b1) (= ((_ extract 14 14) (|safety_island#27| state)) #b1) (= ((_ extract 15 15) (|safety_island#27| state)) #b1) (= ((_ extract 16 16) (|safety_island#27| state)) #b1) (= ((_ extract 17 17) (|safety_island#27| state)) #b1) (= ((_ extract 18 18) (|safety_island#27| state)) #b1) (= ((_ extract 19 19) (|safety_island#27| state)) #b1) (= ((_ extract 20 20) (|safety_island#27| state)) #b1) (= ((_ extract 21 21) (|safety_island#27| state)) #b1) (= ((_ extract 22 22) (|safety_island#27| state)) #b1) (= ((_ extract 23 23) (|safety_island#27| state)) #b1) (= ((_ extract 24 24) (|safety_island#27| state)) #b1) (= ((_ extract 25 25) (|safety_island#27| state)) #b1) (= ((_ extract 26 26) (|safety_island#27| state)) #b1) (= ((_ extract 27 27) (|safety_island#27| state)) #b1) (= ((_ extract 28 28) (|safety_island#27| state)) #b1) (= ((_ extract 29 29) (|safety_island#27| state)) #b1) (= ((_ extract 30 30) (|safety_island#27| state)) #b1) (= ((_ extract 31 31) (|safety_island#27| state)) #b1)))) ; $eq$safety_island_end_to_end_properties.vh:143$372_Y
(define-fun |safety_island#656| ((state |safety_island_s|)) Bool (or  (|safety_island#655| state) false  (= ((_ extract 0 0) (|safety_island#30| state)) #b1) false)) ; $flatten\output_gate.$logic_or$output_gate_properties.vh:124$1102_Y
(define-fun |safety_island_a 75| ((state |safety_island_s|)) Bool (or (|safety_island#656| state) (not (= ((_ extract 0 0) (|safety_island#38| state)) #b1)))) ; output_gate.no_channel_alone
(define-fun |safety_island#657| ((state |safety_island_s|)) Bool (not (or  (= ((_ extract 0 0) (|safety_island#30| state)) #b1) false))) ; $flatten\output_gate.$logic_not$output_gate_properties.vh:45$923_Y
(define-fun |safety_island#658| ((state |safety_island_s|)) Bool (and (or  (|safety_island#655| state) false) (or  (|safety_island#657| state) false))) ; $flatten\output_gate.$logic_and$output_gate_properties.vh:45$924_Y
(define-fun |safety_island#659| ((state |safety_island_s|)) Bool (and (or  (|safety_island#658| state) false) (or  (|safety_island#618| state) false))) ; $flatten\output_gate.$logic_and$output_gate_properties.vh:45$926_Y
(define-fun |safety_island#660| ((state |safety_island_s|)) Bool (and (or  (|safety_island#659| state) false) (or  (|safety_island#619| state) false))) ; $flatten\output_gate.$logic_and$output_gate_properties.vh:45$928_Y
(define-fun |safety_island_a 76| ((state |safety_island_s|)) Bool (or (|safety_island#660| state) (not (= ((_ extract 0 0) (|safety_island#179| state)) #b1)))) ; output_gate.no_clock_is_off
(define-fun |safety_island#661| ((state |safety_island_s|)) Bool (or  (= ((_ extract 0 0) (|safety_island#30| state)) #b1) false  (|safety_island#620| state) false)) ; $flatten\output_gate.$logic_or$output_gate_properties.vh:125$1106_Y
(define-fun |safety_island_a 77| ((state |safety_island_s|)) Bool (or (|safety_island#661| state) (not (= ((_ extract 0 0) (|safety_island#38| state)) #b1)))) ; output_gate.no_sign_of_life_alone
(define-fun |safety_island_a 78| ((state |safety_island_s|)) Bool (or (|safety_island#599| state) (not (= ((_ extract 0 0) (|safety_island#273| state)) #b1)))) ; output_gate.nonsense_is_off
(define-fun |safety_island_a 79| ((state |safety_island_s|)) Bool (or (= ((_ extract 0 0) (|safety_island#208| state)) #b1) (not (= ((_ extract 0 0) (|safety_island#276| state)) #b1)))) ; output_gate.on_once_armed
(define-fun |safety_island#662| ((state |safety_island_s|)) Bool (and (or  (= ((_ extract 0 0) (|safety_island#253| state)) #b1) false) (or  (|safety_island#499| state) false))) ; $flatten\output_gate.$logic_and$output_gate_properties.vh:119$1092_Y
(define-fun |safety_island_a 80| ((state |safety_island_s|)) Bool (or (|safety_island#662| state) (not (= ((_ extract 0 0) (|safety_island#276| state)) #b1)))) ; output_gate.on_while_fed
(define-fun |safety_island_a 81| ((state |safety_island_s|)) Bool (or (|safety_island#564| state) (not (= ((_ extract 0 0) (|safety_island#276| state)) #b1)))) ; output_gate.on_without_fault
(define-fun |safety_island#663| ((state |safety_island_s|)) (_ BitVec 32) (bvnot (concat #b0000000000000000 (|safety_island#191| state)))) ; $flatten\output_gate.$not$output_gate_properties.vh:112$1072_Y
(define-fun |safety_island#664| ((state |safety_island_s|)) (_ BitVec 32) (bvand (concat #b00000000000000000000000 (|safety_island#73| state)) (|safety_island#663| state))) ; $flatten\output_gate.$and$output_gate_properties.vh:112$1073_Y
(define-fun |safety_island#665| ((state |safety_island_s|)) Bool (not (or  (= ((_ extract 0 0) (|safety_island#664| state)) #b1) (= ((_ extract 1 1) (|safety_island#664| state)) #b1) (= ((_ extract 2 2) (|safety_island#664| state)) #b1) (= ((_ extract 3 3) (|safety_island#664| state)) #b1) (= ((_ extract 4 4) (|safety_island#664| state)) #b1) (= ((_ extract 5 5) (|safety_island#664| state)) #b1) (= ((_ extract 6 6) (|safety_island#664| state)) #b1) (= ((_ extract 7 7) (|safety_island#664| state)) #b1) (= ((_ extract 8 8) (|safety_island#664| state)) #b1) (= ((_ extract 9 9) (|safety_island#664| state)) #b1) (= ((_ extract 10 10) (|safety_island#664| state)) #b1) (= ((_ extract 11 11) (|safety_island#664| state)) #b1) (= ((_ extract 12 12) (|safety_island#664| state)) #b1) (= ((_ extract 13 13) (|safety_island#664| state)) #b1) (= ((_ extract 14 14) (|safety_island#664| state)) #b1) (= ((_ extract 15 15) (|safety_island#664| state)) #b1) (= ((_ extract 16 16) (|safety_island#664| state)) #b1) (= ((_ extract 17 17) (|safety_island#664| state)) #b1) (= ((_ extract 18 18) (|safety_island#664| state)) #b1) (= ((_ extract 19 19) (|safety_island#664| state)) #b1) (= ((_ extract 20 20) (|safety_island#664| state)) #b1) (= ((_ extract 21 21) (|safety_island#664| state)) #b1) (= ((_ extract 22 22) (|safety_island#664| state)) #b1) (= ((_ extract 23 23) (|safety_island#664| state)) #b1) (= ((_ extract 24 24) (|safety_island#664| state)) #b1) (= ((_ extract 25 25) (|safety_island#664| state)) #b1) (= ((_ extract 26 26) (|safety_island#664| state)) #b1) (= ((_ extract 27 27) (|safety_island#664| state)) #b1) (= ((_ extract 28 28) (|safety_island#664| state)) #b1) (= ((_ extract 29 29) (|safety_island#664| state)) #b1) (= ((_ extract 30 30) (|safety_island#664| state)) #b1) (= ((_ extract 31 31) (|safety_island#664| state)) #b1)))) ; $flatten\output_gate.$eq$output_gate_properties.vh:112$1074_Y
(define-fun |safety_island_a 82| ((state |safety_island_s|)) Bool (or (|safety_island#665| state) (not (= ((_ extract 0 0) (|safety_island#279| state)) #b1)))) ; output_gate.only_a_cause_is_kept
(define-fun |safety_island#666| ((state |safety_island_s|)) (_ BitVec 32) (bvnot (concat #b00000000000000000000000 (|safety_island#73| state)))) ; $flatten\output_gate.$not$output_gate_properties.vh:107$1056_Y
(define-fun |safety_island#667| ((state |safety_island_s|)) (_ BitVec 32) (bvand (concat #b0000000000000000 (|safety_island#191| state)) (|safety_island#666| state))) ; $flatten\output_gate.$and$output_gate_properties.vh:107$1057_Y
(define-fun |safety_island#668| ((state |safety_island_s|)) Bool (not (or  (= ((_ extract 0 0) (|safety_island#667| state)) #b1) (= ((_ extract 1 1) (|safety_island#667| state)) #b1) (= ((_ extract 2 2) (|safety_island#667| state)) #b1) (= ((_ extract 3 3) (|safety_island#667| state)) #b1) (= ((_ extract 4 4) (|safety_island#667| state)) #b1) (= ((_ extract 5 5) (|safety_island#667| state)) #b1) (= ((_ extract 6 6) (|safety_island#667| state)) #b1) (= ((_ extract 7 7) (|safety_island#667| state)) #b1) (= ((_ extract 8 8) (|safety_island#667| state)) #b1) (= ((_ extract 9 9) (|safety_island#667| state)) #b1) (= ((_ extract 10 10) (|safety_island#667| state)) #b1) (= ((_ extract 11 11) (|safety_island#667| state)) #b1) (= ((_ extract 12 12) (|safety_island#667| state)) #b1) (= ((_ extract 13 13) (|safety_island#667| state)) #b1) (= ((_ extract 14 14) (|safety_island#667| state)) #b1) (= ((_ extract 15 15) (|safety_island#667| state)) #b1) (= ((_ extract 16 16) (|safety_island#667| state)) #b1) (= ((_ extract 17 17) (|safety_island#667| state)) #b1) (= ((_ extract 18 18) (|safety_island#667| state)) #b1) (= ((_ extract 19 19) (|safety_island#667| state)) #b1) (= ((_ extract 20 20) (|safety_island#667| state)) #b1) (= ((_ extract 21 21) (|safety_island#667| state)) #b1) (= ((_ extract 22 22) (|safety_island#667| state)) #b1) (= ((_ extract 23 23) (|safety_island#667| state)) #b1) (= ((_ extract 24 24) (|safety_island#667| state)) #b1) (= ((_ extract 25 25) (|safety_island#667| state)) #b1) (= ((_ extract 26 26) (|safety_island#667| state)) #b1) (= ((_ extract 27 27) (|safety_island#667| state)) #b1) (= ((_ extract 28 28) (|safety_island#667| state)) #b1) (= ((_ extract 29 29) (|safety_island#667| state)) #b1) (= ((_ extract 30 30) (|safety_island#667| state)) #b1) (= ((_ extract 31 31) (|safety_island#667| state)) #b1)))) ; $flatten\output_gate.$eq$output_gate_properties.vh:107$1058_Y
(define-fun |safety_island_a 83| ((state |safety_island_s|)) Bool (or (|safety_island#668| state) (not (= ((_ extract 0 0) (|safety_island#282| state)) #b1)))) ; output_gate.only_a_command_clears
(define-fun |safety_island#669| ((state |safety_island_s|)) (_ BitVec 32) (bvnot (|safety_island#236| state))) ; $flatten\output_gate.$not$output_gate_properties.vh:96$1042_Y
(define-fun |safety_island#670| ((state |safety_island_s|)) (_ BitVec 32) (bvand (|safety_island#27| state) (|safety_island#669| state))) ; $flatten\output_gate.$and$output_gate_properties.vh:96$1043_Y
(define-fun |safety_island#671| ((state |safety_island_s|)) Bool (not (or  (= ((_ extract 0 0) (|safety_island#670| state)) #b1) (= ((_ extract 1 1) (|safety_island#670| state)) #b1) (= ((_ extract 2 2) (|safety_island#670| state)) #b1) (= ((_ extract 3 3) (|safety_island#670| state)) #b1) (= ((_ extract 4 4) (|safety_island#670| state)) #b1) (= ((_ extract 5 5) (|safety_island#670| state)) #b1) (= ((_ extract 6 6) (|safety_island#670| state)) #b1) (= ((_ extract 7 7) (|safety_island#670| state)) #b1) (= ((_ extract 8 8) (|safety_island#670| state)) #b1) (= ((_ extract 9 9) (|safety_island#670| state)) #b1) (= ((_ extract 10 10) (|safety_island#670| state)) #b1) (= ((_ extract 11 11) (|safety_island#670| state)) #b1) (= ((_ extract 12 12) (|safety_island#670| state)) #b1) (= ((_ extract 13 13) (|safety_island#670| state)) #b1) (= ((_ extract 14 14) (|safety_island#670| state)) #b1) (= ((_ extract 15 15) (|safety_island#670| state)) #b1) (= ((_ extract 16 16) (|safety_island#670| state)) #b1) (= ((_ extract 17 17) (|safety_island#670| state)) #b1) (= ((_ extract 18 18) (|safety_island#670| state)) #b1) (= ((_ extract 19 19) (|safety_island#670| state)) #b1) (= ((_ extract 20 20) (|safety_island#670| state)) #b1) (= ((_ extract 21 21) (|safety_island#670| state)) #b1) (= ((_ extract 22 22) (|safety_island#670| state)) #b1) (= ((_ extract 23 23) (|safety_island#670| state)) #b1) (= ((_ extract 24 24) (|safety_island#670| state)) #b1) (= ((_ extract 25 25) (|safety_island#670| state)) #b1) (= ((_ extract 26 26) (|safety_island#670| state)) #b1) (= ((_ extract 27 27) (|safety_island#670| state)) #b1) (= ((_ extract 28 28) (|safety_island#670| state)) #b1) (= ((_ extract 29 29) (|safety_island#670| state)) #b1) (= ((_ extract 30 30) (|safety_island#670| state)) #b1) (= ((_ extract 31 31) (|safety_island#670| state)) #b1)))) ; $flatten\output_gate.$eq$output_gate_properties.vh:96$1044_Y
(define-fun |safety_island_a 84| ((state |safety_island_s|)) Bool (or (|safety_island#671| state) (not (= ((_ extract 0 0) (|safety_island#38| state)) #b1)))) ; output_gate.only_what_is_played
(define-fun |safety_island#672| ((state |safety_island_s|)) Bool (and (or  (|safety_island#599| state) false) (or  (|safety_island#40| state) false))) ; $flatten\output_gate.$logic_and$output_gate_properties.vh:87$1024_Y
(define-fun |safety_island#673| ((state |safety_island_s|)) Bool (and (or  (|safety_island#672| state) false) (or  (|safety_island#564| state) false))) ; $flatten\output_gate.$logic_and$output_gate_properties.vh:87$1026_Y
(define-fun |safety_island#674| ((state |safety_island_s|)) Bool (and (or  (|safety_island#673| state) false) (or  (= ((_ extract 0 0) (|safety_island#17| state)) #b1) false))) ; $flatten\output_gate.$logic_and$output_gate_properties.vh:87$1028_Y
(define-fun |safety_island_a 85| ((state |safety_island_s|)) Bool (or (|safety_island#674| state) (not (= ((_ extract 0 0) (|safety_island#289| state)) #b1)))) ; output_gate.reset_is_off
(define-fun |safety_island#675| ((state |safety_island_s|)) Bool (= (|safety_island#290| state) (ite (|safety_island#199| state) #b1 #b0))) ; $flatten\output_gate.$eq$output_gate_properties.vh:132$1132_Y
(define-fun |safety_island#676| ((state |safety_island_s|)) Bool (bvule (|safety_island#198| state) #b00000000111011100110101100101000)) ; $flatten\output_gate.$le$output_gate_properties.vh:132$1133_Y
(define-fun |safety_island#677| ((state |safety_island_s|)) Bool (and (or  (|safety_island#675| state) false) (or  (|safety_island#676| state) false))) ; $flatten\output_gate.$logic_and$output_gate_properties.vh:132$1134_Y
(define-fun |safety_island_a 86| ((state |safety_island_s|)) Bool (or (|safety_island#677| state) (not (= ((_ extract 0 0) (|safety_island#210| state)) #b1)))) ; output_gate.rest_has_its_time
(define-fun |safety_island#678| ((state |safety_island_s|)) (_ BitVec 32) (bvsub #b00000000111011100110101100101000 (|safety_island#198| state))) ; $flatten\output_gate.$sub$output_gate_properties.vh:133$1135_Y
(define-fun |safety_island#679| ((state |safety_island_s|)) Bool (= (|safety_island#298| state) (|safety_island#678| state))) ; $flatten\output_gate.$eq$output_gate_properties.vh:133$1136_Y
(define-fun |safety_island_a 87| ((state |safety_island_s|)) Bool (or (|safety_island#679| state) (not (= ((_ extract 0 0) (|safety_island#293| state)) #b1)))) ; output_gate.rest_is_counted
(define-fun |safety_island#680| ((state |safety_island_s|)) (_ BitVec 32) (bvand (concat #b000000000000000000000000000 (|safety_island#252| state)) (|safety_island#641| state))) ; $flatten\output_gate.$and$output_gate_properties.vh:122$1099_Y
(define-fun |safety_island#681| ((state |safety_island_s|)) Bool (not (or  (= ((_ extract 0 0) (|safety_island#680| state)) #b1) (= ((_ extract 1 1) (|safety_island#680| state)) #b1) (= ((_ extract 2 2) (|safety_island#680| state)) #b1) (= ((_ extract 3 3) (|safety_island#680| state)) #b1) (= ((_ extract 4 4) (|safety_island#680| state)) #b1) (= ((_ extract 5 5) (|safety_island#680| state)) #b1) (= ((_ extract 6 6) (|safety_island#680| state)) #b1) (= ((_ extract 7 7) (|safety_island#680| state)) #b1) (= ((_ extract 8 8) (|safety_island#680| state)) #b1) (= ((_ extract 9 9) (|safety_island#680| state)) #b1) (= ((_ extract 10 10) (|safety_island#680| state)) #b1) (= ((_ extract 11 11) (|safety_island#680| state)) #b1) (= ((_ extract 12 12) (|safety_island#680| state)) #b1) (= ((_ extract 13 13) (|safety_island#680| state)) #b1) (= ((_ extract 14 14) (|safety_island#680| state)) #b1) (= ((_ extract 15 15) (|safety_island#680| state)) #b1) (= ((_ extract 16 16) (|safety_island#680| state)) #b1) (= ((_ extract 17 17) (|safety_island#680| state)) #b1) (= ((_ extract 18 18) (|safety_island#680| state)) #b1) (= ((_ extract 19 19) (|safety_island#680| state)) #b1) (= ((_ extract 20 20) (|safety_island#680| state)) #b1) (= ((_ extract 21 21) (|safety_island#680| state)) #b1) (= ((_ extract 22 22) (|safety_island#680| state)) #b1) (= ((_ extract 23 23) (|safety_island#680| state)) #b1) (= ((_ extract 24 24) (|safety_island#680| state)) #b1) (= ((_ extract 25 25) (|safety_island#680| state)) #b1) (= ((_ extract 26 26) (|safety_island#680| state)) #b1) (= ((_ extract 27 27) (|safety_island#680| state)) #b1) (= ((_ extract 28 28) (|safety_island#680| state)) #b1) (= ((_ extract 29 29) (|safety_island#680| state)) #b1) (= ((_ extract 30 30) (|safety_island#680| state)) #b1) (= ((_ extract 31 31) (|safety_island#680| state)) #b1)))) ; $flatten\output_gate.$eq$output_gate_properties.vh:122$1100_Y
(define-fun |safety_island_a 88| ((state |safety_island_s|)) Bool (or (|safety_island#681| state) (not (= ((_ extract 0 0) (|safety_island#297| state)) #b1)))) ; output_gate.rest_is_kept
(define-fun |safety_island#682| ((state |safety_island_s|)) Bool (bvult (|safety_island#206| state) #b1111010000100100)) ; $flatten\output_gate.$lt$output_gate_properties.vh:141$1170_Y
(define-fun |safety_island#683| ((state |safety_island_s|)) (_ BitVec 16) (bvsub #b1111010000100011 (|safety_island#206| state))) ; $flatten\output_gate.$sub$output_gate_properties.vh:141$1171_Y
(define-fun |safety_island#684| ((state |safety_island_s|)) Bool (= (|safety_island#300| state) (|safety_island#683| state))) ; $flatten\output_gate.$eq$output_gate_properties.vh:141$1172_Y
(define-fun |safety_island#685| ((state |safety_island_s|)) Bool (and (or  (|safety_island#682| state) false) (or  (|safety_island#684| state) false))) ; $flatten\output_gate.$logic_and$output_gate_properties.vh:141$1173_Y
(define-fun |safety_island_a 89| ((state |safety_island_s|)) Bool (or (|safety_island#685| state) (not (= ((_ extract 0 0) (|safety_island#304| state)) #b1)))) ; output_gate.settling_is_counted
(define-fun |safety_island#686| ((state |safety_island_s|)) (_ BitVec 33) (bvadd (concat #b0 (|safety_island#313| state)) (concat #b0 (|safety_island#325| state)))) ; $flatten\output_gate.$add$output_gate_properties.vh:138$1153_Y
(define-fun |safety_island#687| ((state |safety_island_s|)) Bool (= (|safety_island#686| state) (|safety_island#496| state))) ; $flatten\output_gate.$eq$output_gate_properties.vh:138$1155_Y
(define-fun |safety_island#688| ((state |safety_island_s|)) Bool (= (|safety_island#313| state) (|safety_island#254| state))) ; $flatten\output_gate.$eq$output_gate_properties.vh:138$1152_Y
(define-fun |safety_island#689| ((state |safety_island_s|)) Bool (= (|safety_island#325| state) #b00000000000000000000000000000001)) ; $flatten\output_gate.$eq$output_gate_properties.vh:138$1151_Y
(define-fun |safety_island#690| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#689| state) (ite (|safety_island#688| state) #b1 #b0) (ite (|safety_island#687| state) #b1 #b0))) ; $flatten\output_gate.$ternary$output_gate_properties.vh:138$1156_Y
(define-fun |safety_island_a 90| ((state |safety_island_s|)) Bool (or (= ((_ extract 0 0) (|safety_island#690| state)) #b1) (not (= ((_ extract 0 0) (|safety_island#308| state)) #b1)))) ; output_gate.silence_is_counted
(define-fun |safety_island_a 91| ((state |safety_island_s|)) Bool (or (= ((_ extract 1 1) (|safety_island#73| state)) #b1) (not (= ((_ extract 0 0) (|safety_island#312| state)) #b1)))) ; output_gate.silence_is_kept
(define-fun |safety_island#691| ((state |safety_island_s|)) Bool (bvule (|safety_island#325| state) (|safety_island#254| state))) ; $flatten\output_gate.$le$output_gate_properties.vh:139$1158_Y
(define-fun |safety_island#692| ((state |safety_island_s|)) Bool (or  (|safety_island#691| state) false  (|safety_island#689| state) false)) ; $flatten\output_gate.$logic_or$output_gate_properties.vh:139$1160_Y
(define-fun |safety_island_a 92| ((state |safety_island_s|)) Bool (or (|safety_island#692| state) (not (= ((_ extract 0 0) (|safety_island#308| state)) #b1)))) ; output_gate.silent_in_time
(define-fun |safety_island_a 93| ((state |safety_island_s|)) Bool (or (|safety_island#599| state) (not (= ((_ extract 0 0) (|safety_island#314| state)) #b1)))) ; output_gate.silent_is_off
(define-fun |safety_island_a 94| ((state |safety_island_s|)) Bool (or (= ((_ extract 0 0) (|safety_island#73| state)) #b1) (not (= ((_ extract 0 0) (|safety_island#317| state)) #b1)))) ; output_gate.stop_is_kept
(define-fun |safety_island_a 95| ((state |safety_island_s|)) Bool (or (|safety_island#599| state) (not (= ((_ extract 0 0) (|safety_island#318| state)) #b1)))) ; output_gate.stopped_is_off
(define-fun |safety_island#693| ((state |safety_island_s|)) Bool (bvuge (|safety_island#326| state) #b1111010000100100)) ; $flatten\output_gate.$ge$output_gate_properties.vh:126$1108_Y
(define-fun |safety_island#694| ((state |safety_island_s|)) Bool (or  (|safety_island#655| state) false  (|safety_island#693| state) false)) ; $flatten\output_gate.$logic_or$output_gate_properties.vh:126$1109_Y
(define-fun |safety_island_a 96| ((state |safety_island_s|)) Bool (or (|safety_island#694| state) (not (= ((_ extract 0 0) (|safety_island#38| state)) #b1)))) ; output_gate.supply_has_settled
(define-fun |safety_island_a 97| ((state |safety_island_s|)) Bool (or (= ((_ extract 3 3) (|safety_island#73| state)) #b1) (not (= ((_ extract 0 0) (|safety_island#322| state)) #b1)))) ; output_gate.underrun_is_kept
(define-fun |safety_island_a 98| ((state |safety_island_s|)) Bool (or (|safety_island#599| state) (not (= ((_ extract 0 0) (|safety_island#323| state)) #b1)))) ; output_gate.underrun_is_off
(define-fun |safety_island#695| ((state |safety_island_s|)) Bool (= ((_ extract 1 1) (|safety_island#45| state)) (|safety_island#55| state))) ; $eq$safety_island_end_to_end_properties.vh:137$362_Y
(define-fun |safety_island_a 99| ((state |safety_island_s|)) Bool (or (|safety_island#695| state) (not (= ((_ extract 0 0) (|safety_island#79| state)) #b1)))) ; permit_is_its_pin
(define-fun |safety_island_a 100| ((state |safety_island_s|)) Bool (or (|safety_island#599| state) (not (= ((_ extract 0 0) (|safety_island#332| state)) #b1)))) ; permit_pin_is_off
(define-fun |safety_island#696| ((state |safety_island_s|)) Bool (= (|safety_island#45| state) (concat (|safety_island#55| state) (|safety_island#330| state)))) ; $eq$safety_island_end_to_end_links.vh:30$508_Y
(define-fun |safety_island#697| ((state |safety_island_s|)) Bool (= (|safety_island#47| state) (concat (|safety_island#57| state) (|safety_island#70| state)))) ; $eq$safety_island_end_to_end_links.vh:30$509_Y
(define-fun |safety_island#698| ((state |safety_island_s|)) Bool (and (or  (|safety_island#696| state) false) (or  (|safety_island#697| state) false))) ; $logic_and$safety_island_end_to_end_links.vh:30$510_Y
(define-fun |safety_island_a 101| ((state |safety_island_s|)) Bool (or (|safety_island#698| state) (not (= ((_ extract 0 0) (|safety_island#52| state)) #b1)))) ; permits_are_linked
(define-fun |safety_island#699| ((state |safety_island_s|)) Bool (bvuge (|safety_island#336| state) #b0000000001011101)) ; $ge$safety_island_properties.vh:36$460_Y
(define-fun |safety_island_a 102| ((state |safety_island_s|)) Bool (or (|safety_island#699| state) (not (= ((_ extract 0 0) (|safety_island#38| state)) #b1)))) ; pulse_is_clamped
(define-fun |safety_island#700| ((state |safety_island_s|)) (_ BitVec 1) ((_ extract 0 0) (bvlshr (|safety_island#382| state) (concat #b000000000000000000000000000 (|safety_island#89| state))))) ; $shiftx$safety_island_end_to_end_links.vh:50$573_Y
(define-fun |safety_island#701| ((state |safety_island_s|)) Bool (or  (= ((_ extract 0 0) (|safety_island#700| state)) #b1) false  (|safety_island#451| state) false)) ; $logic_or$safety_island_end_to_end_links.vh:50$575_Y
(define-fun |safety_island#702| ((state |safety_island_s|)) (_ BitVec 17) (bvadd (concat #b0 (|safety_island#350| state)) (concat #b0 (|safety_island#134| state)))) ; $add$safety_island_end_to_end_links.vh:50$576_Y
(define-fun |safety_island#703| ((state |safety_island_s|)) Bool (bvuge (|safety_island#348| state) (concat #b0 (|safety_island#702| state)))) ; $ge$safety_island_end_to_end_links.vh:50$577_Y
(define-fun |safety_island#704| ((state |safety_island_s|)) Bool (or  (|safety_island#701| state) false  (|safety_island#703| state) false)) ; $logic_or$safety_island_end_to_end_links.vh:50$578_Y
(define-fun |safety_island_a 103| ((state |safety_island_s|)) Bool (or (|safety_island#704| state) (not (= ((_ extract 0 0) (|safety_island#52| state)) #b1)))) ; pulses_are_linked
(define-fun |safety_island_a 104| ((state |safety_island_s|)) Bool (or (|safety_island#599| state) (not (= ((_ extract 0 0) (|safety_island#340| state)) #b1)))) ; reset_is_off
(define-fun |safety_island_a 105| ((state |safety_island_s|)) Bool (or (|safety_island#599| state) (not (= ((_ extract 0 0) (|safety_island#345| state)) #b1)))) ; short_pulse_is_off
(define-fun |safety_island#705| ((state |safety_island_s|)) Bool (= (|safety_island#337| state) (|safety_island#325| state))) ; $eq$safety_island_end_to_end_links.vh:36$525_Y
(define-fun |safety_island#706| ((state |safety_island_s|)) Bool (= (|safety_island#338| state) (|safety_island#254| state))) ; $eq$safety_island_end_to_end_links.vh:36$526_Y
(define-fun |safety_island#707| ((state |safety_island_s|)) Bool (and (or  (|safety_island#705| state) false) (or  (|safety_island#706| state) false))) ; $logic_and$safety_island_end_to_end_links.vh:36$527_Y
(define-fun |safety_island_a 106| ((state |safety_island_s|)) Bool (or (|safety_island#707| state) (not (= ((_ extract 0 0) (|safety_island#347| state)) #b1)))) ; silence_is_linked
(define-fun |safety_island#708| ((state |safety_island_s|)) Bool (bvult (|safety_island#350| state) (|safety_island#134| state))) ; $lt$safety_island_end_to_end_links.vh:48$563_Y
(define-fun |safety_island#709| ((state |safety_island_s|)) Bool (= (|safety_island#384| state) (ite (|safety_island#708| state) #b1 #b0))) ; $eq$safety_island_end_to_end_links.vh:48$564_Y
(define-fun |safety_island#710| ((state |safety_island_s|)) Bool (distinct (|safety_island#350| state) #b0000000000000000)) ; $ne$safety_island_end_to_end_links.vh:48$565_Y
(define-fun |safety_island#711| ((state |safety_island_s|)) Bool (and (or  (|safety_island#709| state) false) (or  (|safety_island#710| state) false))) ; $logic_and$safety_island_end_to_end_links.vh:48$566_Y
(define-fun |safety_island_a 107| ((state |safety_island_s|)) Bool (or (|safety_island#711| state) (not (= ((_ extract 0 0) (|safety_island#52| state)) #b1)))) ; soon_is_linked
(define-fun |safety_island#712| ((state |safety_island_s|)) Bool (= (|safety_island#426| state) #b00000000000000001111010000100100)) ; $eq$safety_island_end_to_end_properties.vh:130$353_Y
(define-fun |safety_island#713| ((state |safety_island_s|)) Bool (and (or  (= ((_ extract 0 0) (|safety_island#30| state)) #b1) false) (or  (|safety_island#712| state) false))) ; $logic_and$safety_island_end_to_end_properties.vh:143$374_Y
(define-fun |safety_island#714| ((state |safety_island_s|)) Bool (or  (|safety_island#655| state) false  (|safety_island#713| state) false)) ; $logic_or$safety_island_end_to_end_properties.vh:143$375_Y
(define-fun |safety_island_a 108| ((state |safety_island_s|)) Bool (or (|safety_island#714| state) (not (= ((_ extract 0 0) (|safety_island#79| state)) #b1)))) ; supply_comes_first
(define-fun |safety_island#715| ((state |safety_island_s|)) Bool (= (concat #b000000000 (|safety_island#124| state)) (|safety_island#329| state))) ; $eq$safety_island_end_to_end_links.vh:32$512_Y
(define-fun |safety_island#716| ((state |safety_island_s|)) Bool (= (concat #b00000000000000 (|safety_island#98| state)) (|safety_island#96| state))) ; $eq$safety_island_end_to_end_links.vh:32$513_Y
(define-fun |safety_island#717| ((state |safety_island_s|)) Bool (and (or  (|safety_island#715| state) false) (or  (|safety_island#716| state) false))) ; $logic_and$safety_island_end_to_end_links.vh:32$514_Y
(define-fun |safety_island#718| ((state |safety_island_s|)) Bool (= (|safety_island#83| state) (|safety_island#116| state))) ; $eq$safety_island_end_to_end_links.vh:32$515_Y
(define-fun |safety_island#719| ((state |safety_island_s|)) Bool (and (or  (|safety_island#717| state) false) (or  (|safety_island#718| state) false))) ; $logic_and$safety_island_end_to_end_links.vh:32$516_Y
(define-fun |safety_island#720| ((state |safety_island_s|)) Bool (= (concat #b00000000000 (|safety_island#85| state)) (|safety_island#81| state))) ; $eq$safety_island_end_to_end_links.vh:33$517_Y
(define-fun |safety_island#721| ((state |safety_island_s|)) Bool (and (or  (|safety_island#719| state) false) (or  (|safety_island#720| state) false))) ; $logic_and$safety_island_end_to_end_links.vh:32$518_Y
(define-fun |safety_island#722| ((state |safety_island_s|)) Bool (= (|safety_island#336| state) (|safety_island#335| state))) ; $eq$safety_island_end_to_end_links.vh:33$519_Y
(define-fun |safety_island#723| ((state |safety_island_s|)) Bool (and (or  (|safety_island#721| state) false) (or  (|safety_island#722| state) false))) ; $logic_and$safety_island_end_to_end_links.vh:32$520_Y
(define-fun |safety_island#724| ((state |safety_island_s|)) Bool (and (or  (|safety_island#723| state) false) (or  (|safety_island#590| state) false))) ; $logic_and$safety_island_end_to_end_links.vh:32$522_Y
(define-fun |safety_island#725| ((state |safety_island_s|)) Bool (and (or  (|safety_island#724| state) false) (or  (|safety_island#591| state) false))) ; $logic_and$safety_island_end_to_end_links.vh:32$524_Y
(define-fun |safety_island_a 109| ((state |safety_island_s|)) Bool (or (|safety_island#725| state) (not (= ((_ extract 0 0) (|safety_island#52| state)) #b1)))) ; wishes_are_linked
(define-fun |safety_island#726| ((state |safety_island_s|)) (_ BitVec 32) (bvadd (|safety_island#426| state) #b00000000000000000000000000000001)) ; $add$safety_island_end_to_end_properties.vh:130$354_Y
(define-fun |safety_island#727| ((state |safety_island_s|)) (_ BitVec 32) (ite (|safety_island#712| state) (|safety_island#426| state) (|safety_island#726| state))) ; $ternary$safety_island_end_to_end_properties.vh:130$355_Y
(define-fun |safety_island#728| ((state |safety_island_s|)) Bool (or  (|safety_island#6| state) false  (|safety_island#657| state) false)) ; $flatten\output_gate.$logic_or$output_gate_properties.vh:65$964_Y
(define-fun |safety_island#729| ((state |safety_island_s|)) (_ BitVec 32) (ite (|safety_island#728| state) #b00000000000000000000000000000000 (|safety_island#727| state))) ; $0\up_g[31:0]
(define-fun |safety_island#730| ((state |safety_island_s|)) (_ BitVec 32) (ite (|safety_island#175| state) #b00000000000001011011100011011000 (|safety_island#174| state))) ; $ternary$safety_island_end_to_end_properties.vh:56$293_Y
(define-fun |safety_island#731| ((state |safety_island_s|)) (_ BitVec 32) (ite (|safety_island#58| state) (|safety_island#730| state) (|safety_island#425| state))) ; $procmux$1565_Y
(define-fun |safety_island#732| ((state |safety_island_s|)) (_ BitVec 32) (ite (|safety_island#6| state) #b00000000000001011011100011011000 (|safety_island#731| state))) ; $0\total_most_g[31:0]
(define-fun |safety_island#733| ((state |safety_island_s|)) (_ BitVec 19) (ite (|safety_island#175| state) #b1011011100011011000 ((_ extract 18 0) (|safety_island#174| state)))) ; $ternary$safety_island.v:127$246_Y
(define-fun |safety_island#734| ((state |safety_island_s|)) (_ BitVec 19) (ite (|safety_island#48| state) (|safety_island#733| state) (|safety_island#419| state))) ; $procmux$1545_Y
(define-fun |safety_island#735| ((state |safety_island_s|)) (_ BitVec 19) (ite (|safety_island#6| state) #b1011011100011011000 (|safety_island#734| state))) ; $0\total_edges_q[18:0]
(define-fun |safety_island#736| ((state |safety_island_s|)) Bool (= (|safety_island#412| state) #b1111)) ; $flatten\stage_limits.$eq$stage_limits.v:253$728_Y
(define-fun |safety_island#737| ((state |safety_island_s|)) Bool (or  (= ((_ extract 0 0) (|safety_island#413| state)) #b1) false  (|safety_island#736| state) false)) ; $flatten\stage_limits.$logic_or$stage_limits.v:253$729_Y
(define-fun |safety_island#738| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#387| state)) #b1) (ite (|safety_island#737| state) #b1 #b0) (|safety_island#413| state))) ; $flatten\stage_limits.$procmux$1493_Y
(define-fun |safety_island#739| ((state |safety_island_s|)) Bool (= (|safety_island#392| state) #b11111)) ; $flatten\stage_limits.$eq$stage_limits.v:75$635_Y
(define-fun |safety_island#740| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#739| state) (|safety_island#738| state) (|safety_island#413| state))) ; $flatten\stage_limits.$procmux$1495_Y
(define-fun |safety_island#741| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#6| state) #b0 (|safety_island#740| state))) ; $flatten\stage_limits.$0\parts_full_q[0:0]
(define-fun |safety_island#742| ((state |safety_island_s|)) (_ BitVec 4) (bvadd (|safety_island#412| state) #b0001)) ; $flatten\stage_limits.$add$stage_limits.v:253$731_Y
(define-fun |safety_island#743| ((state |safety_island_s|)) (_ BitVec 4) (ite (= ((_ extract 0 0) (|safety_island#387| state)) #b1) (|safety_island#742| state) (|safety_island#412| state))) ; $flatten\stage_limits.$procmux$1499_Y
(define-fun |safety_island#744| ((state |safety_island_s|)) (_ BitVec 4) (ite (|safety_island#739| state) (|safety_island#743| state) (|safety_island#412| state))) ; $flatten\stage_limits.$procmux$1501_Y
(define-fun |safety_island#745| ((state |safety_island_s|)) (_ BitVec 4) (ite (|safety_island#6| state) #b0000 (|safety_island#744| state))) ; $flatten\stage_limits.$0\part_q[3:0]
(define-fun |safety_island#746| ((state |safety_island_s|)) (_ BitVec 15) (bvadd (|safety_island#409| state) #b000000000000001)) ; $flatten\stage_limits.$add$stage_limits.v:77$636_Y
(define-fun |safety_island#747| ((state |safety_island_s|)) (_ BitVec 15) (ite (= ((_ extract 0 0) (|safety_island#387| state)) #b1) #b000000000000000 (|safety_island#746| state))) ; $flatten\stage_limits.$ternary$stage_limits.v:77$637_Y
(define-fun |safety_island#748| ((state |safety_island_s|)) (_ BitVec 15) (ite (|safety_island#739| state) (|safety_island#747| state) (|safety_island#409| state))) ; $flatten\stage_limits.$procmux$1509_Y
(define-fun |safety_island#749| ((state |safety_island_s|)) (_ BitVec 15) (ite (|safety_island#6| state) #b000000000000000 (|safety_island#748| state))) ; $flatten\stage_limits.$0\round_q[14:0]
(declare-fun |safety_island#750#0| (|safety_island_s|) (Array (_ BitVec 9) (_ BitVec 15))) ; stage_limits.made_by
(define-fun |safety_island_m stage_limits.made_by| ((state |safety_island_s|)) (Array (_ BitVec 9) (_ BitVec 15)) (|safety_island#750#0| state))
(define-fun |safety_island_m:R0A stage_limits.made_by| ((state |safety_island_s|)) (_ BitVec 9) (concat (|safety_island#412| state) (|safety_island#392| state))) ; { \stage_limits.part_q \stage_limits.turn_q }
(define-fun |safety_island#751| ((state |safety_island_s|)) (_ BitVec 15) (select (|safety_island#750#0| state) (|safety_island_m:R0A stage_limits.made_by| state))) ; $flatten\stage_limits.$0\oldest_q[14:0]
(define-fun |safety_island_m:R0D stage_limits.made_by| ((state |safety_island_s|)) (_ BitVec 15) (|safety_island#751| state))
(define-fun |safety_island#752| ((state |safety_island_s|)) Bool (or  (|safety_island#68| state) false  (= ((_ extract 0 0) (|safety_island#406| state)) #b1) false)) ; $flatten\stage_limits.$logic_or$stage_limits.v:266$796_Y
(define-fun |safety_island#753| ((state |safety_island_s|)) Bool (not (or  (= ((_ extract 0 0) (|safety_island#415| state)) #b1) (= ((_ extract 1 1) (|safety_island#415| state)) #b1) (= ((_ extract 2 2) (|safety_island#415| state)) #b1) (= ((_ extract 3 3) (|safety_island#415| state)) #b1) (= ((_ extract 4 4) (|safety_island#415| state)) #b1) (= ((_ extract 5 5) (|safety_island#415| state)) #b1) (= ((_ extract 6 6) (|safety_island#415| state)) #b1) (= ((_ extract 7 7) (|safety_island#415| state)) #b1) (= ((_ extract 8 8) (|safety_island#415| state)) #b1) (= ((_ extract 9 9) (|safety_island#415| state)) #b1) (= ((_ extract 10 10) (|safety_island#415| state)) #b1) (= ((_ extract 11 11) (|safety_island#415| state)) #b1) (= ((_ extract 12 12) (|safety_island#415| state)) #b1) (= ((_ extract 13 13) (|safety_island#415| state)) #b1) (= ((_ extract 14 14) (|safety_island#415| state)) #b1) (= ((_ extract 15 15) (|safety_island#415| state)) #b1) (= ((_ extract 16 16) (|safety_island#415| state)) #b1) (= ((_ extract 17 17) (|safety_island#415| state)) #b1) (= ((_ extract 18 18) (|safety_island#415| state)) #b1) (= ((_ extract 19 19) (|safety_island#415| state)) #b1) (= ((_ extract 20 20) (|safety_island#415| state)) #b1) (= ((_ extract 21 21) (|safety_island#415| state)) #b1) (= ((_ extract 22 22) (|safety_island#415| state)) #b1) (= ((_ extract 23 23) (|safety_island#415| state)) #b1) (= ((_ extract 24 24) (|safety_island#415| state)) #b1) (= ((_ extract 25 25) (|safety_island#415| state)) #b1) (= ((_ extract 26 26) (|safety_island#415| state)) #b1) (= ((_ extract 27 27) (|safety_island#415| state)) #b1) (= ((_ extract 28 28) (|safety_island#415| state)) #b1) (= ((_ extract 29 29) (|safety_island#415| state)) #b1) (= ((_ extract 30 30) (|safety_island#415| state)) #b1) (= ((_ extract 31 31) (|safety_island#415| state)) #b1)))) ; $flatten\stage_limits.$eq$stage_limits.v:266$797_Y
(define-fun |safety_island#754| ((state |safety_island_s|)) Bool (and (or  (|safety_island#752| state) false) (or  (|safety_island#753| state) false))) ; $flatten\stage_limits.$logic_and$stage_limits.v:266$798_Y
(define-fun |safety_island#755| ((state |safety_island_s|)) Bool (not (or  (|safety_island#418| state) false))) ; $flatten\stage_limits.$logic_not$stage_limits.v:266$799_Y
(define-fun |safety_island#756| ((state |safety_island_s|)) Bool (and (or  (|safety_island#754| state) false) (or  (|safety_island#755| state) false))) ; $flatten\stage_limits.$logic_and$stage_limits.v:266$800_Y
(define-fun |safety_island#757| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#6| state) #b1 (ite (|safety_island#756| state) #b1 #b0))) ; $flatten\stage_limits.$0\none_q[0:0]
(define-fun |safety_island#758| ((state |safety_island_s|)) Bool (distinct (|safety_island#398| state) ((_ extract 2 0) (|safety_island#354| state)))) ; $flatten\stage_limits.$0\new_q[0:0]
(define-fun |safety_island#759| ((state |safety_island_s|)) (_ BitVec 32) (bvshl #b00000000000000000000000000000001 (concat #b000000000000000000000000000 (|safety_island#377| state)))) ; $flatten\stage_limits.$0\made_one_q[31:0]
(define-fun |safety_island#760| ((state |safety_island_s|)) (_ BitVec 32) (bvxor (|safety_island#396| state) (|safety_island#400| state))) ; $flatten\stage_limits.$xor$stage_limits.v:150$821_Y
(define-fun |safety_island#761| ((state |safety_island_s|)) (_ BitVec 32) (ite (= ((_ extract 0 0) (|safety_island#383| state)) #b1) (|safety_island#760| state) (|safety_island#396| state))) ; $flatten\stage_limits.$procmux$1232_Y
(define-fun |safety_island#762| ((state |safety_island_s|)) (_ BitVec 32) (ite (|safety_island#6| state) #b00000000000000000000000000000000 (|safety_island#761| state))) ; $flatten\stage_limits.$0\low_bit[2].count_q[31:0]
(define-fun |safety_island#763| ((state |safety_island_s|)) (_ BitVec 32) (bvxor (|safety_island#394| state) (|safety_island#399| state))) ; $flatten\stage_limits.$xor$stage_limits.v:150$817_Y
(define-fun |safety_island#764| ((state |safety_island_s|)) (_ BitVec 32) (ite (= ((_ extract 0 0) (|safety_island#383| state)) #b1) (|safety_island#763| state) (|safety_island#394| state))) ; $flatten\stage_limits.$procmux$1236_Y
(define-fun |safety_island#765| ((state |safety_island_s|)) (_ BitVec 32) (ite (|safety_island#6| state) #b00000000000000000000000000000000 (|safety_island#764| state))) ; $flatten\stage_limits.$0\low_bit[1].count_q[31:0]
(define-fun |safety_island#766| ((state |safety_island_s|)) (_ BitVec 5) (bvadd (|safety_island#392| state) #b00001)) ; $flatten\stage_limits.$add$stage_limits.v:74$634_Y
(define-fun |safety_island#767| ((state |safety_island_s|)) (_ BitVec 5) (ite (|safety_island#6| state) #b00000 (|safety_island#766| state))) ; $flatten\stage_limits.$0\turn_q[4:0]
(define-fun |safety_island#768| ((state |safety_island_s|)) (_ BitVec 32) (bvxor (|safety_island#391| state) (|safety_island#368| state))) ; $flatten\stage_limits.$xor$stage_limits.v:150$813_Y
(define-fun |safety_island#769| ((state |safety_island_s|)) (_ BitVec 32) (ite (= ((_ extract 0 0) (|safety_island#383| state)) #b1) (|safety_island#768| state) (|safety_island#391| state))) ; $flatten\stage_limits.$procmux$1240_Y
(define-fun |safety_island#770| ((state |safety_island_s|)) (_ BitVec 32) (ite (|safety_island#6| state) #b00000000000000000000000000000000 (|safety_island#769| state))) ; $flatten\stage_limits.$0\low_bit[0].count_q[31:0]
(define-fun |safety_island#771| ((state |safety_island_s|)) Bool (not (or  (= ((_ extract 0 0) (|safety_island#387| state)) #b1) false))) ; $flatten\stage_limits.$logic_not$stage_limits.v:78$638_Y
(define-fun |safety_island#772| ((state |safety_island_s|)) Bool (= (|safety_island#746| state) #b111111100101000)) ; $flatten\stage_limits.$eq$stage_limits.v:78$640_Y
(define-fun |safety_island#773| ((state |safety_island_s|)) Bool (and (or  (|safety_island#771| state) false) (or  (|safety_island#772| state) false))) ; $flatten\stage_limits.$logic_and$stage_limits.v:78$641_Y
(define-fun |safety_island#774| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#739| state) (ite (|safety_island#773| state) #b1 #b0) (|safety_island#387| state))) ; $flatten\stage_limits.$procmux$1505_Y
(define-fun |safety_island#775| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#6| state) #b0 (|safety_island#774| state))) ; $flatten\stage_limits.$0\last_round_q[0:0]
(define-fun |safety_island#776| ((state |safety_island_s|)) (_ BitVec 17) (bvadd (concat #b0 (|safety_island#350| state)) #b00000000000000001)) ; $flatten\stage_limits.$add$stage_limits.v:125$654_Y
(define-fun |safety_island#777| ((state |safety_island_s|)) Bool (bvult (|safety_island#776| state) (concat #b0 (|safety_island#336| state)))) ; $flatten\stage_limits.$lt$stage_limits.v:125$655_Y
(define-fun |safety_island#778| ((state |safety_island_s|)) Bool (bvugt (|safety_island#336| state) #b0000000000000001)) ; $flatten\stage_limits.$gt$stage_limits.v:125$653_Y
(define-fun |safety_island#779| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#383| state)) #b1) (ite (|safety_island#778| state) #b1 #b0) (ite (|safety_island#777| state) #b1 #b0))) ; $flatten\stage_limits.$ternary$stage_limits.v:125$656_Y
(define-fun |safety_island#780| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#6| state) #b0 (|safety_island#779| state))) ; $flatten\stage_limits.$0\soon_q[0:0]
(define-fun |safety_island#781| ((state |safety_island_s|)) Bool (distinct (|safety_island#367| state) #b00000000000000000000000000000000)) ; $flatten\stage_limits.$ne$stage_limits.v:102$648_Y
(define-fun |safety_island#782| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#6| state) #b0 (ite (|safety_island#781| state) #b1 #b0))) ; $flatten\stage_limits.$0\moved_q[0:0]
(define-fun |safety_island#783| ((state |safety_island_s|)) (_ BitVec 32) (bvor (|safety_island#386| state) (|safety_island#368| state))) ; $flatten\stage_limits.$or$stage_limits.v:128$657_Y
(define-fun |safety_island#784| ((state |safety_island_s|)) (_ BitVec 32) (ite (= ((_ extract 0 0) (|safety_island#383| state)) #b1) (|safety_island#783| state) (|safety_island#382| state))) ; $flatten\stage_limits.$procmux$1464_Y
(define-fun |safety_island#785| ((state |safety_island_s|)) (_ BitVec 32) (ite (|safety_island#6| state) #b00000000000000000000000000000000 (|safety_island#784| state))) ; $flatten\stage_limits.$0\recent_q[31:0]
(define-fun |safety_island#786| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#739| state) #b0 (|safety_island#379| state))) ; $flatten\stage_limits.$procmux$1489_Y
(define-fun |safety_island#787| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#6| state) #b1 (|safety_island#786| state))) ; $flatten\stage_limits.$0\first_round_q[0:0]
(define-fun |safety_island#788| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#6| state) #b0 (|safety_island#365| state))) ; $flatten\stage_limits.$0\first_moves_q[0:0]
(define-fun |safety_island#789| ((state |safety_island_s|)) (_ BitVec 12) (bvadd ((_ extract 14 3) (|safety_island#354| state)) (concat #b00000000000 (ite (|safety_island#420| state) #b1 #b0)))) ; $flatten\stage_limits.$0\made_q[14:0] [14:3]
(define-fun |safety_island#790| ((state |safety_island_s|)) (_ BitVec 32) (ite (|safety_island#6| state) #b00000000000000000000000000000000 (|safety_island#367| state))) ; $flatten\stage_limits.$0\change_q[31:0]
(define-fun |safety_island#791| ((state |safety_island_s|)) (_ BitVec 32) (ite (|safety_island#6| state) #b00000000000000000000000000000000 (|safety_island#27| state))) ; $0\channel_1_g[31:0]
(define-fun |safety_island#792| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#6| state) #b0 (ite (|safety_island#411| state) #b1 #b0))) ; $flatten\stage_limits.$0\begun_q[0:0]
(define-fun |safety_island#793| ((state |safety_island_s|)) (_ BitVec 15) (ite (= ((_ extract 0 0) (|safety_island#374| state)) #b1) (|safety_island#407| state) #b000000000000000)) ; $flatten\stage_limits.$0\base_q[14:0]
(define-fun |safety_island#794| ((state |safety_island_s|)) (_ BitVec 21) (bvadd (|safety_island#361| state) (concat #b00 (|safety_island#419| state)))) ; $flatten\stage_limits.$0\all_limit_q[20:0]
(declare-fun |safety_island#795#0| (|safety_island_s|) (Array (_ BitVec 4) (_ BitVec 21))) ; stage_limits.made_in
(define-fun |safety_island_m stage_limits.made_in| ((state |safety_island_s|)) (Array (_ BitVec 4) (_ BitVec 21)) (|safety_island#795#0| state))
(define-fun |safety_island_m:R0A stage_limits.made_in| ((state |safety_island_s|)) (_ BitVec 4) (|safety_island#742| state)) ; $flatten\stage_limits.$add$stage_limits.v:253$731_Y
(define-fun |safety_island#796| ((state |safety_island_s|)) (_ BitVec 21) (select (|safety_island#795#0| state) (|safety_island_m:R0A stage_limits.made_in| state))) ; $flatten\stage_limits.$memrd$\made_in$stage_limits.v:253$730_DATA
(define-fun |safety_island_m:R0D stage_limits.made_in| ((state |safety_island_s|)) (_ BitVec 21) (|safety_island#796| state))
(define-fun |safety_island#797| ((state |safety_island_s|)) (_ BitVec 21) (ite (|safety_island#737| state) (|safety_island#796| state) #b000000000000000000000)) ; $flatten\stage_limits.$ternary$stage_limits.v:253$732_Y
(define-fun |safety_island#798| ((state |safety_island_s|)) (_ BitVec 21) (ite (|safety_island#411| state) (|safety_island#797| state) (|safety_island#361| state))) ; $flatten\stage_limits.$procmux$1372_Y
(define-fun |safety_island#799| ((state |safety_island_s|)) (_ BitVec 21) (ite (|safety_island#6| state) #b000000000000000000000 (|safety_island#798| state))) ; $flatten\stage_limits.$0\all_base_q[20:0]
(define-fun |safety_island#800| ((state |safety_island_s|)) (_ BitVec 2) (bvadd (concat #b0 ((_ extract 28 28) (|safety_island#368| state))) (concat #b0 ((_ extract 29 29) (|safety_island#368| state))))) ; $auto$wreduce.cc:513:run$2623 [1:0]
(define-fun |safety_island#801| ((state |safety_island_s|)) (_ BitVec 3) (bvadd (concat #b0 (|safety_island#800| state)) (concat #b00 ((_ extract 30 30) (|safety_island#368| state))))) ; $flatten\stage_limits.$add$stage_limits.v:222$765_Y
(define-fun |safety_island#802| ((state |safety_island_s|)) (_ BitVec 3) (bvadd (|safety_island#801| state) (concat #b00 ((_ extract 31 31) (|safety_island#368| state))))) ; $flatten\stage_limits.$add$stage_limits.v:222$766_Y
(define-fun |safety_island#803| ((state |safety_island_s|)) (_ BitVec 2) (bvadd (concat #b0 ((_ extract 24 24) (|safety_island#368| state))) (concat #b0 ((_ extract 25 25) (|safety_island#368| state))))) ; $auto$wreduce.cc:513:run$2622 [1:0]
(define-fun |safety_island#804| ((state |safety_island_s|)) (_ BitVec 3) (bvadd (concat #b0 (|safety_island#803| state)) (concat #b00 ((_ extract 26 26) (|safety_island#368| state))))) ; $flatten\stage_limits.$add$stage_limits.v:222$768_Y
(define-fun |safety_island#805| ((state |safety_island_s|)) (_ BitVec 3) (bvadd (|safety_island#804| state) (concat #b00 ((_ extract 27 27) (|safety_island#368| state))))) ; $flatten\stage_limits.$add$stage_limits.v:222$769_Y
(define-fun |safety_island#806| ((state |safety_island_s|)) (_ BitVec 4) (bvadd (concat #b0 (|safety_island#802| state)) (concat #b0 (|safety_island#805| state)))) ; $flatten\stage_limits.$add$stage_limits.v:226$770_Y
(define-fun |safety_island#807| ((state |safety_island_s|)) (_ BitVec 2) (bvadd (concat #b0 ((_ extract 20 20) (|safety_island#368| state))) (concat #b0 ((_ extract 21 21) (|safety_island#368| state))))) ; $auto$wreduce.cc:513:run$2621 [1:0]
(define-fun |safety_island#808| ((state |safety_island_s|)) (_ BitVec 3) (bvadd (concat #b0 (|safety_island#807| state)) (concat #b00 ((_ extract 22 22) (|safety_island#368| state))))) ; $flatten\stage_limits.$add$stage_limits.v:222$772_Y
(define-fun |safety_island#809| ((state |safety_island_s|)) (_ BitVec 3) (bvadd (|safety_island#808| state) (concat #b00 ((_ extract 23 23) (|safety_island#368| state))))) ; $flatten\stage_limits.$add$stage_limits.v:222$773_Y
(define-fun |safety_island#810| ((state |safety_island_s|)) (_ BitVec 2) (bvadd (concat #b0 ((_ extract 16 16) (|safety_island#368| state))) (concat #b0 ((_ extract 17 17) (|safety_island#368| state))))) ; $auto$wreduce.cc:513:run$2620 [1:0]
(define-fun |safety_island#811| ((state |safety_island_s|)) (_ BitVec 3) (bvadd (concat #b0 (|safety_island#810| state)) (concat #b00 ((_ extract 18 18) (|safety_island#368| state))))) ; $flatten\stage_limits.$add$stage_limits.v:222$775_Y
(define-fun |safety_island#812| ((state |safety_island_s|)) (_ BitVec 3) (bvadd (|safety_island#811| state) (concat #b00 ((_ extract 19 19) (|safety_island#368| state))))) ; $flatten\stage_limits.$add$stage_limits.v:222$776_Y
(define-fun |safety_island#813| ((state |safety_island_s|)) (_ BitVec 4) (bvadd (concat #b0 (|safety_island#809| state)) (concat #b0 (|safety_island#812| state)))) ; $flatten\stage_limits.$add$stage_limits.v:226$777_Y
(define-fun |safety_island#814| ((state |safety_island_s|)) (_ BitVec 5) (bvadd (concat #b0 (|safety_island#806| state)) (concat #b0 (|safety_island#813| state)))) ; $auto$wreduce.cc:513:run$2615 [4:0]
(define-fun |safety_island#815| ((state |safety_island_s|)) (_ BitVec 2) (bvadd (concat #b0 ((_ extract 12 12) (|safety_island#368| state))) (concat #b0 ((_ extract 13 13) (|safety_island#368| state))))) ; $auto$wreduce.cc:513:run$2619 [1:0]
(define-fun |safety_island#816| ((state |safety_island_s|)) (_ BitVec 3) (bvadd (concat #b0 (|safety_island#815| state)) (concat #b00 ((_ extract 14 14) (|safety_island#368| state))))) ; $flatten\stage_limits.$add$stage_limits.v:222$779_Y
(define-fun |safety_island#817| ((state |safety_island_s|)) (_ BitVec 3) (bvadd (|safety_island#816| state) (concat #b00 ((_ extract 15 15) (|safety_island#368| state))))) ; $flatten\stage_limits.$add$stage_limits.v:222$780_Y
(define-fun |safety_island#818| ((state |safety_island_s|)) (_ BitVec 2) (bvadd (concat #b0 ((_ extract 8 8) (|safety_island#368| state))) (concat #b0 ((_ extract 9 9) (|safety_island#368| state))))) ; $auto$wreduce.cc:513:run$2618 [1:0]
(define-fun |safety_island#819| ((state |safety_island_s|)) (_ BitVec 3) (bvadd (concat #b0 (|safety_island#818| state)) (concat #b00 ((_ extract 10 10) (|safety_island#368| state))))) ; $flatten\stage_limits.$add$stage_limits.v:222$782_Y
(define-fun |safety_island#820| ((state |safety_island_s|)) (_ BitVec 3) (bvadd (|safety_island#819| state) (concat #b00 ((_ extract 11 11) (|safety_island#368| state))))) ; $flatten\stage_limits.$add$stage_limits.v:222$783_Y
(define-fun |safety_island#821| ((state |safety_island_s|)) (_ BitVec 4) (bvadd (concat #b0 (|safety_island#817| state)) (concat #b0 (|safety_island#820| state)))) ; $flatten\stage_limits.$add$stage_limits.v:226$784_Y
(define-fun |safety_island#822| ((state |safety_island_s|)) (_ BitVec 2) (bvadd (concat #b0 ((_ extract 4 4) (|safety_island#368| state))) (concat #b0 ((_ extract 5 5) (|safety_island#368| state))))) ; $auto$wreduce.cc:513:run$2617 [1:0]
(define-fun |safety_island#823| ((state |safety_island_s|)) (_ BitVec 3) (bvadd (concat #b0 (|safety_island#822| state)) (concat #b00 ((_ extract 6 6) (|safety_island#368| state))))) ; $flatten\stage_limits.$add$stage_limits.v:222$786_Y
(define-fun |safety_island#824| ((state |safety_island_s|)) (_ BitVec 3) (bvadd (|safety_island#823| state) (concat #b00 ((_ extract 7 7) (|safety_island#368| state))))) ; $flatten\stage_limits.$add$stage_limits.v:222$787_Y
(define-fun |safety_island#825| ((state |safety_island_s|)) (_ BitVec 2) (bvadd (concat #b0 ((_ extract 0 0) (|safety_island#368| state))) (concat #b0 ((_ extract 1 1) (|safety_island#368| state))))) ; $auto$wreduce.cc:513:run$2616 [1:0]
(define-fun |safety_island#826| ((state |safety_island_s|)) (_ BitVec 3) (bvadd (concat #b0 (|safety_island#825| state)) (concat #b00 ((_ extract 2 2) (|safety_island#368| state))))) ; $flatten\stage_limits.$add$stage_limits.v:222$789_Y
(define-fun |safety_island#827| ((state |safety_island_s|)) (_ BitVec 3) (bvadd (|safety_island#826| state) (concat #b00 ((_ extract 3 3) (|safety_island#368| state))))) ; $flatten\stage_limits.$add$stage_limits.v:222$790_Y
(define-fun |safety_island#828| ((state |safety_island_s|)) (_ BitVec 4) (bvadd (concat #b0 (|safety_island#824| state)) (concat #b0 (|safety_island#827| state)))) ; $flatten\stage_limits.$add$stage_limits.v:226$791_Y
(define-fun |safety_island#829| ((state |safety_island_s|)) (_ BitVec 5) (bvadd (concat #b0 (|safety_island#821| state)) (concat #b0 (|safety_island#828| state)))) ; $auto$wreduce.cc:513:run$2614 [4:0]
(define-fun |safety_island#830| ((state |safety_island_s|)) (_ BitVec 6) (bvadd (concat #b0 (|safety_island#814| state)) (concat #b0 (|safety_island#829| state)))) ; $flatten\stage_limits.$add$stage_limits.v:230$794_Y
(define-fun |safety_island#831| ((state |safety_island_s|)) (_ BitVec 6) (ite (= ((_ extract 0 0) (|safety_island#383| state)) #b1) (|safety_island#830| state) #b000000)) ; $flatten\stage_limits.$procmux$1351_Y
(define-fun |safety_island#832| ((state |safety_island_s|)) (_ BitVec 6) (ite (|safety_island#6| state) #b000000 (|safety_island#831| state))) ; $flatten\stage_limits.$0\moves_q[5:0]
(define-fun |safety_island#833| ((state |safety_island_s|)) Bool (distinct (|safety_island#359| state) #b000000)) ; $flatten\stage_limits.$ne$stage_limits.v:258$737_Y
(define-fun |safety_island#834| ((state |safety_island_s|)) (_ BitVec 21) (ite (|safety_island#833| state) (|safety_island#360| state) (|safety_island#358| state))) ; $flatten\stage_limits.$procmux$1376_Y
(define-fun |safety_island#835| ((state |safety_island_s|)) (_ BitVec 21) (ite (|safety_island#6| state) #b000000000000000000000 (|safety_island#834| state))) ; $flatten\stage_limits.$0\all_q[20:0]
(define-fun |safety_island#836| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#6| state) #b0 (ite (|safety_island#416| state) #b1 #b0))) ; $flatten\stage_limits.$0\begins_q[0:0]
(define-fun |safety_island#837| ((state |safety_island_s|)) (_ BitVec 18) (bvadd (|safety_island#357| state) #b000000000000000001)) ; $flatten\stage_limits.$add$stage_limits.v:272$805_Y
(define-fun |safety_island#838| ((state |safety_island_s|)) (_ BitVec 18) (ite (|safety_island#389| state) (|safety_island#357| state) (|safety_island#837| state))) ; $flatten\stage_limits.$ternary$stage_limits.v:272$806_Y
(define-fun |safety_island#839| ((state |safety_island_s|)) (_ BitVec 18) (ite (|safety_island#10| state) (|safety_island#838| state) #b000000000000000000)) ; $flatten\stage_limits.$procmux$1346_Y
(define-fun |safety_island#840| ((state |safety_island_s|)) (_ BitVec 18) (ite (|safety_island#6| state) #b000000000000000000 (|safety_island#839| state))) ; $flatten\stage_limits.$0\age_q[17:0]
(declare-fun |safety_island#841#0| (|safety_island_s|) (Array (_ BitVec 5) (_ BitVec 15))) ; stage_limits.accounts
(define-fun |safety_island_m stage_limits.accounts| ((state |safety_island_s|)) (Array (_ BitVec 5) (_ BitVec 15)) (|safety_island#841#0| state))
(define-fun |safety_island_m:R0A stage_limits.accounts| ((state |safety_island_s|)) (_ BitVec 5) (|safety_island#392| state)) ; \stage_limits.turn_q
(define-fun |safety_island#842| ((state |safety_island_s|)) (_ BitVec 15) (select (|safety_island#841#0| state) (|safety_island_m:R0A stage_limits.accounts| state))) ; $flatten\stage_limits.$0\account_q[14:0]
(define-fun |safety_island_m:R0D stage_limits.accounts| ((state |safety_island_s|)) (_ BitVec 15) (|safety_island#842| state))
(define-fun |safety_island#843| ((state |safety_island_s|)) (_ BitVec 19) (bvadd (|safety_island#351| state) #b0000000000000000001)) ; $add$safety_island_end_to_end_properties.vh:114$333_Y
(define-fun |safety_island#844| ((state |safety_island_s|)) Bool (= (|safety_island#351| state) #b1111111111111111111)) ; $reduce_and$safety_island_end_to_end_properties.vh:114$332_Y
(define-fun |safety_island#845| ((state |safety_island_s|)) (_ BitVec 19) (ite (|safety_island#844| state) (|safety_island#351| state) (|safety_island#843| state))) ; $ternary$safety_island_end_to_end_properties.vh:114$334_Y
(define-fun |safety_island#846| ((state |safety_island_s|)) Bool (not (or  (|safety_island#10| state) false))) ; $logic_not$safety_island_end_to_end_properties.vh:114$329_Y
(define-fun |safety_island#847| ((state |safety_island_s|)) Bool (or  (|safety_island#416| state) false  (|safety_island#846| state) false)) ; $logic_or$safety_island_end_to_end_properties.vh:114$330_Y
(define-fun |safety_island#848| ((state |safety_island_s|)) Bool (or  (|safety_island#847| state) false  (|safety_island#40| state) false)) ; $logic_or$safety_island_end_to_end_properties.vh:114$331_Y
(define-fun |safety_island#849| ((state |safety_island_s|)) (_ BitVec 19) (ite (|safety_island#848| state) #b0000000000000000000 (|safety_island#845| state))) ; $ternary$safety_island_end_to_end_properties.vh:114$335_Y
(define-fun |safety_island#850| ((state |safety_island_s|)) (_ BitVec 19) (ite (|safety_island#6| state) #b0000000000000000000 (|safety_island#849| state))) ; $0\sounds_g[18:0]
(define-fun |safety_island#851| ((state |safety_island_s|)) (_ BitVec 16) (bvadd (|safety_island#350| state) #b0000000000000001)) ; $flatten\stage_limits.$add$stage_limits.v:129$659_Y
(define-fun |safety_island#852| ((state |safety_island_s|)) Bool (distinct (|safety_island#350| state) #b1111111111111111)) ; $flatten\stage_limits.$ne$stage_limits.v:129$658_Y
(define-fun |safety_island#853| ((state |safety_island_s|)) (_ BitVec 16) (ite (|safety_island#852| state) (|safety_island#851| state) (|safety_island#350| state))) ; $flatten\stage_limits.$procmux$1468_Y
(define-fun |safety_island#854| ((state |safety_island_s|)) (_ BitVec 16) (ite (= ((_ extract 0 0) (|safety_island#383| state)) #b1) #b0000000000000001 (|safety_island#853| state))) ; $flatten\stage_limits.$procmux$1471_Y
(define-fun |safety_island#855| ((state |safety_island_s|)) (_ BitVec 16) (ite (|safety_island#6| state) #b1111111111111111 (|safety_island#854| state))) ; $flatten\stage_limits.$0\since_q[15:0]
(define-fun |safety_island#856| ((state |safety_island_s|)) (_ BitVec 18) (bvadd (|safety_island#349| state) #b000000000000000001)) ; $add$safety_island_end_to_end_properties.vh:94$320_Y
(define-fun |safety_island#857| ((state |safety_island_s|)) Bool (= (|safety_island#349| state) #b100000000000000000)) ; $eq$safety_island_end_to_end_properties.vh:94$319_Y
(define-fun |safety_island#858| ((state |safety_island_s|)) (_ BitVec 18) (ite (|safety_island#857| state) (|safety_island#349| state) (|safety_island#856| state))) ; $ternary$safety_island_end_to_end_properties.vh:94$321_Y
(define-fun |safety_island#859| ((state |safety_island_s|)) (_ BitVec 18) (ite (|safety_island#92| state) #b000000000000000001 (|safety_island#858| state))) ; $ternary$safety_island_end_to_end_properties.vh:94$322_Y
(define-fun |safety_island#860| ((state |safety_island_s|)) Bool (distinct (|safety_island#334| state) (|safety_island#335| state))) ; $ne$safety_island_end_to_end_properties.vh:94$317_Y
(define-fun |safety_island#861| ((state |safety_island_s|)) Bool (and (or  (|safety_island#40| state) false) (or  (|safety_island#860| state) false))) ; $logic_and$safety_island_end_to_end_properties.vh:94$318_Y
(define-fun |safety_island#862| ((state |safety_island_s|)) (_ BitVec 18) (ite (|safety_island#861| state) #b100000000000000000 (|safety_island#859| state))) ; $ternary$safety_island_end_to_end_properties.vh:94$323_Y
(define-fun |safety_island#863| ((state |safety_island_s|)) (_ BitVec 18) (ite (|safety_island#6| state) #b100000000000000000 (|safety_island#862| state))) ; $0\since_g[17:0]
(define-fun |safety_island#864| ((state |safety_island_s|)) (_ BitVec 18) (ite (|safety_island#6| state) #b100000000000000000 (|safety_island#349| state))) ; $0\since_1_g[17:0]
(define-fun |safety_island#865| ((state |safety_island_s|)) (_ BitVec 3) (ite (|safety_island#6| state) #b000 (concat ((_ extract 1 0) (|safety_island#343| state)) (ite (|safety_island#423| state) #b1 #b0)))) ; $0\short_g[2:0]
(define-fun |safety_island#866| ((state |safety_island_s|)) (_ BitVec 32) (ite (|safety_island#115| state) (|safety_island#329| state) (|safety_island#338| state))) ; $procmux$1597_Y
(define-fun |safety_island#867| ((state |safety_island_s|)) (_ BitVec 32) (ite (|safety_island#6| state) #b00000000000000000000000000000000 (|safety_island#866| state))) ; $0\quiet_most_g[31:0]
(define-fun |safety_island#868| ((state |safety_island_s|)) (_ BitVec 32) (bvadd (|safety_island#337| state) #b00000000000000000000000000000001)) ; $add$safety_island_end_to_end_properties.vh:76$301_Y
(define-fun |safety_island#869| ((state |safety_island_s|)) Bool (= (|safety_island#337| state) #b11111111111111111111111111111111)) ; $eq$safety_island_end_to_end_properties.vh:76$300_Y
(define-fun |safety_island#870| ((state |safety_island_s|)) (_ BitVec 32) (ite (|safety_island#869| state) (|safety_island#337| state) (|safety_island#868| state))) ; $ternary$safety_island_end_to_end_properties.vh:76$302_Y
(define-fun |safety_island#871| ((state |safety_island_s|)) (_ BitVec 32) (ite (|safety_island#115| state) #b00000000000000000000000000000001 (|safety_island#870| state))) ; $ternary$safety_island_end_to_end_properties.vh:76$303_Y
(define-fun |safety_island#872| ((state |safety_island_s|)) (_ BitVec 32) (ite (|safety_island#6| state) #b11111111111111111111111111111111 (|safety_island#871| state))) ; $0\quiet_g[31:0]
(define-fun |safety_island#873| ((state |safety_island_s|)) (_ BitVec 16) (ite (|safety_island#40| state) (|safety_island#334| state) (|safety_island#336| state))) ; $procmux$1521_Y
(define-fun |safety_island#874| ((state |safety_island_s|)) (_ BitVec 16) (ite (|safety_island#6| state) #b0000000001011101 (|safety_island#873| state))) ; $0\pulse_ticks_q[15:0]
(define-fun |safety_island#875| ((state |safety_island_s|)) (_ BitVec 16) (ite (|safety_island#40| state) (|safety_island#334| state) (|safety_island#335| state))) ; $procmux$1577_Y
(define-fun |safety_island#876| ((state |safety_island_s|)) (_ BitVec 16) (ite (|safety_island#6| state) #b0000000001011101 (|safety_island#875| state))) ; $0\pulse_least_g[15:0]
(define-fun |safety_island#877| ((state |safety_island_s|)) (_ BitVec 3) (ite (|safety_island#6| state) #b000 (concat (|safety_island#55| state) (concat (|safety_island#330| state) (ite (|safety_island#341| state) #b1 #b0))))) ; { $0\permit_3_g[0:0] $0\permit_2_g[0:0] $0\permit_1_g[0:0] }
(define-fun |safety_island#878| ((state |safety_island_s|)) (_ BitVec 32) (ite (|safety_island#172| state) #b00000000010111110101111000010000 (|safety_island#123| state))) ; $ternary$safety_island_end_to_end_properties.vh:45$277_Y
(define-fun |safety_island#879| ((state |safety_island_s|)) (_ BitVec 32) (ite (|safety_island#40| state) (|safety_island#878| state) (|safety_island#329| state))) ; $procmux$1573_Y
(define-fun |safety_island#880| ((state |safety_island_s|)) (_ BitVec 32) (ite (|safety_island#6| state) #b00000000010111110101111000010000 (|safety_island#879| state))) ; $0\patience_g[31:0]
(define-fun |safety_island#881| ((state |safety_island_s|)) Bool (bvsgt (|safety_island#328| state) #b001011011100011011000100000000000000000)) ; $gt$safety_island_end_to_end_properties.vh:116$339_Y
(define-fun |safety_island#882| ((state |safety_island_s|)) (_ BitVec 39) (ite (|safety_island#881| state) #b001011011100011011000100000000000000000 (|safety_island#328| state))) ; $ternary$safety_island_end_to_end_properties.vh:116$340_Y
(define-fun |safety_island#883| ((state |safety_island_s|)) Bool (or  (= ((_ extract 0 0) (|safety_island#167| state)) #b1) false  (= ((_ extract 38 38) (|safety_island#328| state)) #b1) false)) ; $logic_or$safety_island_end_to_end_properties.vh:116$338_Y
(define-fun |safety_island#884| ((state |safety_island_s|)) (_ BitVec 39) (ite (|safety_island#883| state) #b000000000000000000000000000000000000000 (|safety_island#882| state))) ; $ternary$safety_island_end_to_end_properties.vh:116$341_Y
(define-fun |safety_island#885| ((state |safety_island_s|)) (_ BitVec 39) (ite (|safety_island#6| state) #b000000000000000000000000000000000000000 (|safety_island#884| state))) ; $0\owed_g[38:0]
(define-fun |safety_island#886| ((state |safety_island_s|)) (_ BitVec 16) (bvadd (|safety_island#326| state) #b0000000000000001)) ; $flatten\output_gate.$add$output_gate_properties.vh:15$961_Y
(define-fun |safety_island#887| ((state |safety_island_s|)) Bool (= (|safety_island#326| state) #b1111010000100100)) ; $flatten\output_gate.$eq$output_gate_properties.vh:15$960_Y
(define-fun |safety_island#888| ((state |safety_island_s|)) (_ BitVec 16) (ite (|safety_island#887| state) #b1111010000100100 (|safety_island#886| state))) ; $flatten\output_gate.$0\longer$func$output_gate_properties.vh:65$824.$result[15:0]$932
(define-fun |safety_island#889| ((state |safety_island_s|)) (_ BitVec 16) (ite (|safety_island#728| state) #b0000000000000000 (|safety_island#888| state))) ; $flatten\output_gate.$0\up_q[15:0]
(define-fun |safety_island#890| ((state |safety_island_s|)) (_ BitVec 32) (bvadd (|safety_island#325| state) #b00000000000000000000000000000001)) ; $flatten\output_gate.$add$output_gate_properties.vh:79$989_Y
(define-fun |safety_island#891| ((state |safety_island_s|)) Bool (= (|safety_island#325| state) #b11111111111111111111111111111111)) ; $flatten\output_gate.$eq$output_gate_properties.vh:79$988_Y
(define-fun |safety_island#892| ((state |safety_island_s|)) (_ BitVec 32) (ite (|safety_island#891| state) (|safety_island#325| state) (|safety_island#890| state))) ; $flatten\output_gate.$ternary$output_gate_properties.vh:79$990_Y
(define-fun |safety_island#893| ((state |safety_island_s|)) (_ BitVec 32) (ite (|safety_island#121| state) #b00000000000000000000000000000001 (|safety_island#892| state))) ; $flatten\output_gate.$0\unfed_q[31:0]
(define-fun |safety_island#894| ((state |safety_island_s|)) (_ BitVec 32) (bvadd (|safety_island#324| state) #b00000000000000000000000000000001)) ; $flatten\output_gate.$add$output_gate.v:122$866_Y
(define-fun |safety_island#895| ((state |safety_island_s|)) Bool (and (or  (= ((_ extract 0 0) (|safety_island#20| state)) #b1) false) (or  (= ((_ extract 0 0) (|safety_island#220| state)) #b1) false))) ; $flatten\output_gate.$logic_and$output_gate.v:122$865_Y
(define-fun |safety_island#896| ((state |safety_island_s|)) (_ BitVec 32) (ite (|safety_island#895| state) (|safety_island#894| state) (|safety_island#324| state))) ; $flatten\output_gate.$procmux$2331_Y
(define-fun |safety_island#897| ((state |safety_island_s|)) (_ BitVec 32) (ite (|safety_island#6| state) #b00000000000000000000000000000000 (|safety_island#896| state))) ; $flatten\output_gate.$0\underruns_q[31:0]
(define-fun |safety_island#898| ((state |safety_island_s|)) (_ BitVec 32) (bvsub (|safety_island#313| state) #b00000000000000000000000000000001)) ; $flatten\output_gate.$sub$output_gate.v:105$852_Y
(define-fun |safety_island#899| ((state |safety_island_s|)) (_ BitVec 32) (ite (= ((_ extract 0 0) (|safety_island#17| state)) #b1) (|safety_island#313| state) (|safety_island#898| state))) ; $flatten\output_gate.$procmux$2360_Y
(define-fun |safety_island#900| ((state |safety_island_s|)) (_ BitVec 32) (ite (|safety_island#121| state) (concat #b000000000 (|safety_island#124| state)) (|safety_island#899| state))) ; $flatten\output_gate.$procmux$2363_Y
(define-fun |safety_island#901| ((state |safety_island_s|)) (_ BitVec 32) (ite (|safety_island#6| state) #b00000000000000000000000000000000 (|safety_island#900| state))) ; $flatten\output_gate.$0\silence_q[31:0]
(define-fun |safety_island#902| ((state |safety_island_s|)) (_ BitVec 16) (bvsub (|safety_island#300| state) #b0000000000000001)) ; $flatten\output_gate.$sub$output_gate.v:135$868_Y
(define-fun |safety_island#903| ((state |safety_island_s|)) (_ BitVec 16) (ite (|safety_island#243| state) (|safety_island#902| state) #b1111010000100011)) ; $flatten\output_gate.$ternary$output_gate.v:135$869_Y
(define-fun |safety_island#904| ((state |safety_island_s|)) (_ BitVec 16) (ite (|safety_island#6| state) #b0000000000000000 (|safety_island#903| state))) ; $flatten\output_gate.$0\settle_left_q[15:0]
(define-fun |safety_island#905| ((state |safety_island_s|)) (_ BitVec 32) (bvsub (|safety_island#298| state) #b00000000000000000000000000000001)) ; $flatten\output_gate.$sub$output_gate.v:115$860_Y
(define-fun |safety_island#906| ((state |safety_island_s|)) (_ BitVec 32) (ite (= ((_ extract 0 0) (|safety_island#290| state)) #b1) (|safety_island#905| state) (|safety_island#298| state))) ; $flatten\output_gate.$procmux$2346_Y
(define-fun |safety_island#907| ((state |safety_island_s|)) Bool (distinct ((_ extract 8 4) (|safety_island#221| state)) #b00000)) ; $flatten\output_gate.$ne$output_gate.v:111$859_Y
(define-fun |safety_island#908| ((state |safety_island_s|)) (_ BitVec 32) (ite (|safety_island#907| state) #b00000000111011100110101100101000 (|safety_island#906| state))) ; $flatten\output_gate.$procmux$2349_Y
(define-fun |safety_island#909| ((state |safety_island_s|)) (_ BitVec 32) (ite (|safety_island#6| state) #b00000000000000000000000000000000 (|safety_island#908| state))) ; $flatten\output_gate.$0\rest_left_q[31:0]
(define-fun |safety_island#910| ((state |safety_island_s|)) Bool (distinct (|safety_island#298| state) #b00000000000000000000000000000001)) ; $flatten\output_gate.$ne$output_gate.v:116$861_Y
(define-fun |safety_island#911| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#290| state)) #b1) (ite (|safety_island#910| state) #b1 #b0) #b0)) ; $flatten\output_gate.$procmux$2339_Y
(define-fun |safety_island#912| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#907| state) #b1 (|safety_island#911| state))) ; $flatten\output_gate.$procmux$2342_Y
(define-fun |safety_island#913| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#6| state) #b0 (|safety_island#912| state))) ; $flatten\output_gate.$0\resting_q[0:0]
(define-fun |safety_island#914| ((state |safety_island_s|)) (_ BitVec 3) (bvand (concat ((_ extract 1 0) (|safety_island#275| state)) (ite (|safety_island#248| state) #b1 #b0)) (concat (ite (|safety_island#284| state) #b1 #b0) (concat (ite (|safety_island#284| state) #b1 #b0) (ite (|safety_island#284| state) #b1 #b0))))) ; $flatten\output_gate.$and$output_gate.v:136$870_Y
(define-fun |safety_island#915| ((state |safety_island_s|)) (_ BitVec 3) (ite (|safety_island#6| state) #b000 (|safety_island#914| state))) ; $flatten\output_gate.$0\on_later_q[2:0]
(define-fun |safety_island#916| ((state |safety_island_s|)) (_ BitVec 3) (bvand (concat ((_ extract 1 0) (|safety_island#268| state)) (ite (|safety_island#247| state) #b1 #b0)) (concat (ite (|safety_island#284| state) #b1 #b0) (concat (ite (|safety_island#284| state) #b1 #b0) (ite (|safety_island#284| state) #b1 #b0))))) ; $flatten\output_gate.$and$output_gate.v:137$871_Y
(define-fun |safety_island#917| ((state |safety_island_s|)) (_ BitVec 3) (ite (|safety_island#6| state) #b000 (|safety_island#916| state))) ; $flatten\output_gate.$0\moves_later_q[2:0]
(define-fun |safety_island#918| ((state |safety_island_s|)) (_ BitVec 16) (bvsub (|safety_island#255| state) #b0000000000000001)) ; $flatten\output_gate.$sub$output_gate.v:143$883_Y
(define-fun |safety_island#919| ((state |safety_island_s|)) Bool (distinct (|safety_island#255| state) #b0000000000000000)) ; $flatten\output_gate.$ne$output_gate.v:143$882_Y
(define-fun |safety_island#920| ((state |safety_island_s|)) (_ BitVec 16) (ite (|safety_island#919| state) (|safety_island#918| state) (|safety_island#255| state))) ; $flatten\output_gate.$procmux$2317_Y
(define-fun |safety_island#921| ((state |safety_island_s|)) (_ BitVec 16) (bvsub (|safety_island#63| state) #b0000000000000001)) ; $flatten\output_gate.$sub$output_gate.v:142$881_Y
(define-fun |safety_island#922| ((state |safety_island_s|)) (_ BitVec 16) (ite (|safety_island#102| state) (|safety_island#921| state) (|safety_island#920| state))) ; $flatten\output_gate.$procmux$2320_Y
(define-fun |safety_island#923| ((state |safety_island_s|)) (_ BitVec 16) (ite (|safety_island#285| state) (|safety_island#922| state) #b0000000000000000)) ; $flatten\output_gate.$procmux$2323_Y
(define-fun |safety_island#924| ((state |safety_island_s|)) (_ BitVec 16) (ite (|safety_island#6| state) #b0000000000000000 (|safety_island#923| state))) ; $flatten\output_gate.$0\focus_left_q[15:0]
(define-fun |safety_island#925| ((state |safety_island_s|)) (_ BitVec 32) (ite (|safety_island#121| state) (concat #b000000000 (|safety_island#124| state)) (|safety_island#254| state))) ; $flatten\output_gate.$0\fed_ticks_q[31:0]
(define-fun |safety_island#926| ((state |safety_island_s|)) Bool (or  (= ((_ extract 0 0) (|safety_island#253| state)) #b1) false  (|safety_island#121| state) false)) ; $flatten\output_gate.$logic_or$output_gate_properties.vh:77$985_Y
(define-fun |safety_island#927| ((state |safety_island_s|)) Bool (and (or  (|safety_island#7| state) false) (or  (|safety_island#926| state) false))) ; $flatten\output_gate.$0\fed_q[0:0]
(define-fun |safety_island#928| ((state |safety_island_s|)) Bool (bvule (|safety_island#11| state) #b101)) ; $flatten\output_gate.$0\exists_1_q[0:0]
(define-fun |safety_island#929| ((state |safety_island_s|)) Bool (not (or  (|safety_island#48| state) false))) ; $flatten\output_gate.$logic_not$output_gate_properties.vh:76$978_Y
(define-fun |safety_island#930| ((state |safety_island_s|)) Bool (and (or  (|safety_island#7| state) false) (or  (|safety_island#929| state) false))) ; $flatten\output_gate.$logic_and$output_gate_properties.vh:76$979_Y
(define-fun |safety_island#931| ((state |safety_island_s|)) Bool (and (or  (|safety_island#75| state) false) (or  (|safety_island#110| state) false))) ; $flatten\output_gate.$logic_and$output_gate_properties.vh:76$981_Y
(define-fun |safety_island#932| ((state |safety_island_s|)) Bool (or  (= ((_ extract 0 0) (|safety_island#233| state)) #b1) false  (|safety_island#931| state) false)) ; $flatten\output_gate.$logic_or$output_gate_properties.vh:76$982_Y
(define-fun |safety_island#933| ((state |safety_island_s|)) Bool (and (or  (|safety_island#930| state) false) (or  (|safety_island#932| state) false))) ; $flatten\output_gate.$0\disarmed_q[0:0]
(define-fun |safety_island#934| ((state |safety_island_s|)) Bool (and (or  (= ((_ extract 0 0) (|safety_island#208| state)) #b1) false) (or  (= ((_ extract 1 1) (|safety_island#45| state)) #b1) false))) ; $flatten\output_gate.$logic_and$output_gate_properties.vh:75$968_Y
(define-fun |safety_island#935| ((state |safety_island_s|)) Bool (and (or  (|safety_island#934| state) false) (or  (= ((_ extract 1 1) (|safety_island#47| state)) #b1) false))) ; $flatten\output_gate.$logic_and$output_gate_properties.vh:75$969_Y
(define-fun |safety_island#936| ((state |safety_island_s|)) Bool (and (or  (|safety_island#935| state) false) (or  (|safety_island#18| state) false))) ; $flatten\output_gate.$logic_and$output_gate_properties.vh:75$970_Y
(define-fun |safety_island#937| ((state |safety_island_s|)) Bool (not (or  (= ((_ extract 0 0) (|safety_island#143| state)) #b1) (= ((_ extract 0 0) (|safety_island#144| state)) #b1) (= ((_ extract 0 0) (|safety_island#145| state)) #b1) (= ((_ extract 0 0) (|safety_island#146| state)) #b1) (= ((_ extract 0 0) (|safety_island#147| state)) #b1)))) ; $flatten\output_gate.$eq$output_gate_properties.vh:75$971_Y
(define-fun |safety_island#938| ((state |safety_island_s|)) Bool (and (or  (|safety_island#936| state) false) (or  (|safety_island#937| state) false))) ; $flatten\output_gate.$logic_and$output_gate_properties.vh:75$972_Y
(define-fun |safety_island#939| ((state |safety_island_s|)) Bool (not (or  (= ((_ extract 0 0) (|safety_island#220| state)) #b1) false))) ; $flatten\output_gate.$logic_not$output_gate_properties.vh:75$973_Y
(define-fun |safety_island#940| ((state |safety_island_s|)) Bool (and (or  (|safety_island#938| state) false) (or  (|safety_island#939| state) false))) ; $flatten\output_gate.$logic_and$output_gate_properties.vh:75$974_Y
(define-fun |safety_island#941| ((state |safety_island_s|)) Bool (or  (|safety_island#48| state) false  (|safety_island#940| state) false)) ; $flatten\output_gate.$logic_or$output_gate_properties.vh:75$975_Y
(define-fun |safety_island#942| ((state |safety_island_s|)) Bool (and (or  (|safety_island#7| state) false) (or  (|safety_island#941| state) false))) ; $flatten\output_gate.$0\allowed_q[0:0]
(define-fun |safety_island#943| ((state |safety_island_s|)) (_ BitVec 11) (bvsub (|safety_island#207| state) #b00000000001)) ; $flatten\output_gate.$sub$output_gate.v:146$886_Y
(define-fun |safety_island#944| ((state |safety_island_s|)) Bool (not (or  (= ((_ extract 0 0) (|safety_island#207| state)) #b1) (= ((_ extract 1 1) (|safety_island#207| state)) #b1) (= ((_ extract 2 2) (|safety_island#207| state)) #b1) (= ((_ extract 3 3) (|safety_island#207| state)) #b1) (= ((_ extract 4 4) (|safety_island#207| state)) #b1) (= ((_ extract 5 5) (|safety_island#207| state)) #b1) (= ((_ extract 6 6) (|safety_island#207| state)) #b1) (= ((_ extract 7 7) (|safety_island#207| state)) #b1) (= ((_ extract 8 8) (|safety_island#207| state)) #b1) (= ((_ extract 9 9) (|safety_island#207| state)) #b1) (= ((_ extract 10 10) (|safety_island#207| state)) #b1)))) ; $flatten\output_gate.$eq$output_gate.v:145$885_Y
(define-fun |safety_island#945| ((state |safety_island_s|)) (_ BitVec 11) (ite (|safety_island#944| state) #b11000011001 (|safety_island#943| state))) ; $flatten\output_gate.$procmux$2294_Y
(define-fun |safety_island#946| ((state |safety_island_s|)) (_ BitVec 11) (ite (|safety_island#285| state) (|safety_island#945| state) #b00000000000)) ; $flatten\output_gate.$procmux$2297_Y
(define-fun |safety_island#947| ((state |safety_island_s|)) (_ BitVec 11) (ite (|safety_island#6| state) #b00000000000 (|safety_island#946| state))) ; $flatten\output_gate.$0\alive_left_q[10:0]
(define-fun |safety_island#948| ((state |safety_island_s|)) (_ BitVec 16) (bvadd (|safety_island#206| state) #b0000000000000001)) ; $flatten\output_gate.$add$output_gate_properties.vh:15$936_Y
(define-fun |safety_island#949| ((state |safety_island_s|)) (_ BitVec 16) (ite (|safety_island#654| state) #b1111010000100100 (|safety_island#948| state))) ; $flatten\output_gate.$0\longer$func$output_gate_properties.vh:60$823.$result[15:0]$930
(define-fun |safety_island#950| ((state |safety_island_s|)) Bool (not (or  (|safety_island#284| state) false))) ; $flatten\output_gate.$logic_not$output_gate_properties.vh:60$938_Y
(define-fun |safety_island#951| ((state |safety_island_s|)) Bool (or  (|safety_island#6| state) false  (|safety_island#950| state) false)) ; $flatten\output_gate.$logic_or$output_gate_properties.vh:60$939_Y
(define-fun |safety_island#952| ((state |safety_island_s|)) Bool (not (or  (|safety_island#248| state) false))) ; $flatten\output_gate.$logic_not$output_gate_properties.vh:60$940_Y
(define-fun |safety_island#953| ((state |safety_island_s|)) Bool (or  (|safety_island#951| state) false  (|safety_island#952| state) false)) ; $flatten\output_gate.$logic_or$output_gate_properties.vh:60$941_Y
(define-fun |safety_island#954| ((state |safety_island_s|)) (_ BitVec 16) (ite (|safety_island#953| state) #b0000000000000000 (|safety_island#949| state))) ; $flatten\output_gate.$0\age_q[15:0]
(define-fun |safety_island#955| ((state |safety_island_s|)) (_ BitVec 16) (ite (|safety_island#951| state) #b0000000000000000 (|safety_island#204| state))) ; $flatten\output_gate.$0\age_4_q[15:0]
(define-fun |safety_island#956| ((state |safety_island_s|)) (_ BitVec 16) (ite (|safety_island#951| state) #b0000000000000000 (|safety_island#203| state))) ; $flatten\output_gate.$0\age_3_q[15:0]
(define-fun |safety_island#957| ((state |safety_island_s|)) (_ BitVec 16) (ite (|safety_island#951| state) #b0000000000000000 (|safety_island#202| state))) ; $flatten\output_gate.$0\age_2_q[15:0]
(define-fun |safety_island#958| ((state |safety_island_s|)) (_ BitVec 16) (ite (|safety_island#951| state) #b0000000000000000 (|safety_island#206| state))) ; $flatten\output_gate.$0\age_1_q[15:0]
(define-fun |safety_island#959| ((state |safety_island_s|)) (_ BitVec 32) (bvadd (|safety_island#198| state) #b00000000000000000000000000000001)) ; $flatten\output_gate.$add$output_gate_properties.vh:80$997_Y
(define-fun |safety_island#960| ((state |safety_island_s|)) Bool (= (|safety_island#198| state) #b00000000111011100110101100101000)) ; $flatten\output_gate.$eq$output_gate_properties.vh:80$996_Y
(define-fun |safety_island#961| ((state |safety_island_s|)) (_ BitVec 32) (ite (|safety_island#960| state) #b00000000111011100110101100101000 (|safety_island#959| state))) ; $flatten\output_gate.$ternary$output_gate_properties.vh:80$998_Y
(define-fun |safety_island#962| ((state |safety_island_s|)) Bool (or  (= ((_ extract 0 0) (|safety_island#143| state)) #b1) (= ((_ extract 0 0) (|safety_island#144| state)) #b1) (= ((_ extract 0 0) (|safety_island#145| state)) #b1) (= ((_ extract 0 0) (|safety_island#146| state)) #b1) (= ((_ extract 0 0) (|safety_island#147| state)) #b1))) ; $flatten\output_gate.$ne$output_gate_properties.vh:80$992_Y
(define-fun |safety_island#963| ((state |safety_island_s|)) Bool (and (or  (= ((_ extract 0 0) (|safety_island#20| state)) #b1) false) (or  (|safety_island#962| state) false))) ; $flatten\output_gate.$logic_and$output_gate_properties.vh:80$993_Y
(define-fun |safety_island#964| ((state |safety_island_s|)) Bool (or  false (= ((_ extract 0 0) (|safety_island#144| state)) #b1) (= ((_ extract 0 0) (|safety_island#145| state)) #b1) false false)) ; $flatten\output_gate.$ne$output_gate_properties.vh:80$994_Y
(define-fun |safety_island#965| ((state |safety_island_s|)) Bool (or  (|safety_island#963| state) false  (|safety_island#964| state) false)) ; $flatten\output_gate.$logic_or$output_gate_properties.vh:80$995_Y
(define-fun |safety_island#966| ((state |safety_island_s|)) (_ BitVec 32) (ite (|safety_island#965| state) #b00000000000000000000000000000000 (|safety_island#961| state))) ; $flatten\output_gate.$ternary$output_gate_properties.vh:80$999_Y
(define-fun |safety_island#967| ((state |safety_island_s|)) (_ BitVec 32) (ite (|safety_island#6| state) #b00000000111011100110101100101000 (|safety_island#966| state))) ; $flatten\output_gate.$0\since_limit_q[31:0]
(define-fun |safety_island#968| ((state |safety_island_s|)) (_ BitVec 4) (ite (|safety_island#6| state) #b0000 (concat ((_ extract 2 0) (|safety_island#183| state)) (ite (|safety_island#40| state) #b1 #b0)))) ; $0\off_g[3:0]
(define-fun |safety_island#969| ((state |safety_island_s|)) Bool (bvsgt (|safety_island#327| state) (concat ((_ extract 22 0) (|safety_island#81| state)) #b0000000000000000))) ; $gt$safety_island_end_to_end_properties.vh:117$342_Y
(define-fun |safety_island#970| ((state |safety_island_s|)) Bool (and (or  (|safety_island#15| state) false) (or  (|safety_island#969| state) false))) ; $logic_and$safety_island_end_to_end_properties.vh:117$343_Y
(define-fun |safety_island#971| ((state |safety_island_s|)) (_ BitVec 2) (ite (|safety_island#6| state) #b00 (concat ((_ extract 0 0) (|safety_island#176| state)) (ite (|safety_island#970| state) #b1 #b0)))) ; $0\much_g[1:0]
(define-fun |safety_island#972| ((state |safety_island_s|)) Bool (and (or  (|safety_island#15| state) false) (or  (= ((_ extract 23 23) (|safety_island#372| state)) #b1) false))) ; $flatten\stage_limits.$logic_and$stage_limits.v:273$807_Y
(define-fun |safety_island#973| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#6| state) #b0 (ite (|safety_island#972| state) #b1 #b0))) ; $flatten\stage_limits.$0\duty_q[0:0]
(define-fun |safety_island#974| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#6| state) #b0 (ite (|safety_island#389| state) #b1 #b0))) ; $flatten\stage_limits.$0\late_q[0:0]
(define-fun |safety_island#975| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#833| state) ((_ extract 20 20) (|safety_island#363| state)) #b0)) ; $flatten\stage_limits.$procmux$1337_Y
(define-fun |safety_island#976| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#6| state) #b0 (|safety_island#975| state))) ; $flatten\stage_limits.$0\total_edges_q[0:0]
(define-fun |safety_island#977| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#6| state) #b0 (ite (|safety_island#418| state) #b1 #b0))) ; $flatten\stage_limits.$0\edges_q[0:0]
(define-fun |safety_island#978| ((state |safety_island_s|)) Bool (distinct (|safety_island#415| state) #b00000000000000000000000000000000)) ; $flatten\stage_limits.$ne$stage_limits.v:264$795_Y
(define-fun |safety_island#979| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#6| state) #b0 (ite (|safety_island#978| state) #b1 #b0))) ; $flatten\stage_limits.$0\short_q[0:0]
(define-fun |safety_island#980| ((state |safety_island_s|)) (_ BitVec 16) (ite (|safety_island#6| state) #b0000000001011101 (|safety_island#335| state))) ; $0\least_1_g[15:0]
(define-fun |safety_island#981| ((state |safety_island_s|)) Bool (bvuge (concat #b0000000000000 (|safety_island#351| state)) (|safety_island#96| state))) ; $ge$safety_island_end_to_end_properties.vh:115$336_Y
(define-fun |safety_island#982| ((state |safety_island_s|)) Bool (and (or  (|safety_island#10| state) false) (or  (|safety_island#981| state) false))) ; $logic_and$safety_island_end_to_end_properties.vh:115$337_Y
(define-fun |safety_island#983| ((state |safety_island_s|)) (_ BitVec 2) (ite (|safety_island#6| state) #b00 (concat ((_ extract 0 0) (|safety_island#133| state)) (ite (|safety_island#982| state) #b1 #b0)))) ; $0\late_g[1:0]
(define-fun |safety_island#984| ((state |safety_island_s|)) (_ BitVec 23) (ite (|safety_island#172| state) #b10111110101111000010000 ((_ extract 22 0) (|safety_island#123| state)))) ; $ternary$safety_island.v:118$240_Y
(define-fun |safety_island#985| ((state |safety_island_s|)) (_ BitVec 23) (ite (|safety_island#40| state) (|safety_island#984| state) (|safety_island#124| state))) ; $procmux$1537_Y
(define-fun |safety_island#986| ((state |safety_island_s|)) (_ BitVec 23) (ite (|safety_island#6| state) #b10111110101111000010000 (|safety_island#985| state))) ; $0\heartbeat_ticks_q[22:0]
(define-fun |safety_island#987| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#48| state) (|safety_island#112| state) (|safety_island#118| state))) ; $procmux$1541_Y
(define-fun |safety_island#988| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#6| state) #b0 (|safety_island#987| state))) ; $0\link_q[0:0]
(define-fun |safety_island#989| ((state |safety_island_s|)) (_ BitVec 17) (ite (|safety_island#173| state) #b00100110011001101 (|safety_island#82| state))) ; $ternary$safety_island.v:120$242_Y
(define-fun |safety_island#990| ((state |safety_island_s|)) (_ BitVec 17) (ite (|safety_island#40| state) (|safety_island#989| state) (|safety_island#116| state))) ; $procmux$1553_Y
(define-fun |safety_island#991| ((state |safety_island_s|)) (_ BitVec 17) (ite (|safety_island#6| state) #b00100110011001101 (|safety_island#990| state))) ; $0\share_g[16:0]
(define-fun |safety_island#992| ((state |safety_island_s|)) Bool (and (or  (|safety_island#305| state) false) (or  (|safety_island#43| state) false))) ; $flatten\output_gate.$logic_and$output_gate.v:118$863_Y
(define-fun |safety_island#993| ((state |safety_island_s|)) (_ BitVec 64) (ite (|safety_island#992| state) (|safety_island#182| state) (|safety_island#107| state))) ; $flatten\output_gate.$procmux$2327_Y
(define-fun |safety_island#994| ((state |safety_island_s|)) (_ BitVec 64) (ite (|safety_island#6| state) #b0000000000000000000000000000000000000000000000000000000000000000 (|safety_island#993| state))) ; $flatten\output_gate.$0\fault_time_q[63:0]
(define-fun |safety_island#995| ((state |safety_island_s|)) (_ BitVec 32) (bvadd (|safety_island#106| state) #b00000000000000000000000000000001)) ; $flatten\output_gate.$add$output_gate.v:119$864_Y
(define-fun |safety_island#996| ((state |safety_island_s|)) (_ BitVec 32) (ite (|safety_island#992| state) (|safety_island#995| state) (|safety_island#106| state))) ; $flatten\output_gate.$procmux$2335_Y
(define-fun |safety_island#997| ((state |safety_island_s|)) (_ BitVec 32) (ite (|safety_island#6| state) #b00000000000000000000000000000000 (|safety_island#996| state))) ; $flatten\output_gate.$0\fault_count_q[31:0]
(define-fun |safety_island#998| ((state |safety_island_s|)) (_ BitVec 32) (bvadd (|safety_island#101| state) #b00000000000000000000000000000001)) ; $flatten\output_gate.$add$output_gate.v:140$879_Y
(define-fun |safety_island#999| ((state |safety_island_s|)) Bool (and (or  (|safety_island#102| state) false) (or  (|safety_island#285| state) false))) ; $flatten\output_gate.$logic_and$output_gate.v:140$878_Y
(define-fun |safety_island#1000| ((state |safety_island_s|)) (_ BitVec 32) (ite (|safety_island#999| state) (|safety_island#998| state) (|safety_island#101| state))) ; $flatten\output_gate.$procmux$2313_Y
(define-fun |safety_island#1001| ((state |safety_island_s|)) (_ BitVec 32) (ite (|safety_island#6| state) #b00000000000000000000000000000000 (|safety_island#1000| state))) ; $flatten\output_gate.$0\emissions_q[31:0]
(define-fun |safety_island#1002| ((state |safety_island_s|)) (_ BitVec 18) (ite (|safety_island#171| state) #b100000000010110010 ((_ extract 17 0) (|safety_island#97| state)))) ; $ternary$safety_island.v:119$241_Y
(define-fun |safety_island#1003| ((state |safety_island_s|)) (_ BitVec 18) (ite (|safety_island#40| state) (|safety_island#1002| state) (|safety_island#98| state))) ; $procmux$1529_Y
(define-fun |safety_island#1004| ((state |safety_island_s|)) (_ BitVec 18) (ite (|safety_island#6| state) #b100000000010110010 (|safety_island#1003| state))) ; $0\emission_ticks_q[17:0]
(define-fun |safety_island#1005| ((state |safety_island_s|)) (_ BitVec 32) (ite (|safety_island#171| state) #b00000000000000100000000010110010 (|safety_island#97| state))) ; $ternary$safety_island_end_to_end_properties.vh:46$279_Y
(define-fun |safety_island#1006| ((state |safety_island_s|)) (_ BitVec 32) (ite (|safety_island#40| state) (|safety_island#1005| state) (|safety_island#96| state))) ; $procmux$1561_Y
(define-fun |safety_island#1007| ((state |safety_island_s|)) (_ BitVec 32) (ite (|safety_island#6| state) #b00000000000000100000000010110010 (|safety_island#1006| state))) ; $0\emission_most_g[31:0]
(define-fun |safety_island#1008| ((state |safety_island_s|)) (_ BitVec 32) (ite (|safety_island#170| state) #b00000000000000000011001111000010 (|safety_island#65| state))) ; $ternary$safety_island_end_to_end_properties.vh:55$291_Y
(define-fun |safety_island#1009| ((state |safety_island_s|)) (_ BitVec 32) (ite (|safety_island#58| state) (|safety_island#1008| state) (|safety_island#94| state))) ; $procmux$1569_Y
(define-fun |safety_island#1010| ((state |safety_island_s|)) (_ BitVec 32) (ite (|safety_island#6| state) #b00000000000000000011001111000010 (|safety_island#1009| state))) ; $0\edges_most_g[31:0]
(define-fun |safety_island#1011| ((state |safety_island_s|)) Bool (and (or  (|safety_island#7| state) false) (or  (|safety_island#92| state) false))) ; $0\edge_1_g[0:0]
(define-fun |safety_island#1012| ((state |safety_island_s|)) (_ BitVec 21) (ite (|safety_island#169| state) #b101101110001101100000 ((_ extract 20 0) (|safety_island#84| state)))) ; $ternary$safety_island.v:121$243_Y
(define-fun |safety_island#1013| ((state |safety_island_s|)) (_ BitVec 21) (ite (|safety_island#40| state) (|safety_island#1012| state) (|safety_island#85| state))) ; $procmux$1525_Y
(define-fun |safety_island#1014| ((state |safety_island_s|)) (_ BitVec 21) (ite (|safety_island#6| state) #b101101110001101100000 (|safety_island#1013| state))) ; $0\duty_ticks_q[20:0]
(define-fun |safety_island#1015| ((state |safety_island_s|)) (_ BitVec 17) (ite (|safety_island#40| state) (|safety_island#989| state) (|safety_island#83| state))) ; $procmux$1517_Y
(define-fun |safety_island#1016| ((state |safety_island_s|)) (_ BitVec 17) (ite (|safety_island#6| state) #b00100110011001101 (|safety_island#1015| state))) ; $0\duty_share_q[16:0]
(define-fun |safety_island#1017| ((state |safety_island_s|)) (_ BitVec 32) (ite (|safety_island#169| state) #b00000000000101101110001101100000 (|safety_island#84| state))) ; $ternary$safety_island_end_to_end_properties.vh:48$283_Y
(define-fun |safety_island#1018| ((state |safety_island_s|)) (_ BitVec 32) (ite (|safety_island#40| state) (|safety_island#1017| state) (|safety_island#81| state))) ; $procmux$1557_Y
(define-fun |safety_island#1019| ((state |safety_island_s|)) (_ BitVec 32) (ite (|safety_island#6| state) #b00000000000101101110001101100000 (|safety_island#1018| state))) ; $0\duty_most_g[31:0]
(define-fun |safety_island#1020| ((state |safety_island_s|)) Bool (and (or  (|safety_island#15| state) false) (or  (|safety_island#381| state) false))) ; $flatten\stage_limits.$logic_and$stage_limits.v:275$810_Y
(define-fun |safety_island#1021| ((state |safety_island_s|)) (_ BitVec 38) (ite (|safety_island#1020| state) (|safety_island#80| state) (|safety_island#390| state))) ; $flatten\stage_limits.$procmux$1365_Y
(define-fun |safety_island#1022| ((state |safety_island_s|)) Bool (not (or  (|safety_island#15| state) false))) ; $flatten\stage_limits.$logic_not$stage_limits.v:274$808_Y
(define-fun |safety_island#1023| ((state |safety_island_s|)) Bool (and (or  (|safety_island#1022| state) false) (or  (|safety_island#373| state) false))) ; $flatten\stage_limits.$logic_and$stage_limits.v:274$809_Y
(define-fun |safety_island#1024| ((state |safety_island_s|)) (_ BitVec 38) (ite (|safety_island#1023| state) #b00000000000000000000000000000000000000 (|safety_island#1021| state))) ; $flatten\stage_limits.$procmux$1368_Y
(define-fun |safety_island#1025| ((state |safety_island_s|)) (_ BitVec 38) (ite (|safety_island#6| state) #b00000000000000000000000000000000000000 (|safety_island#1024| state))) ; $flatten\stage_limits.$0\level_q[37:0]
(define-fun |safety_island#1026| ((state |safety_island_s|)) (_ BitVec 9) (ite (|safety_island#68| state) (|safety_island#299| state) (|safety_island#73| state))) ; $flatten\output_gate.$ternary$output_gate.v:109$854_Y
(define-fun |safety_island#1027| ((state |safety_island_s|)) (_ BitVec 9) (bvor (|safety_island#1026| state) (|safety_island#221| state))) ; $flatten\output_gate.$or$output_gate.v:109$855_Y
(define-fun |safety_island#1028| ((state |safety_island_s|)) (_ BitVec 9) (ite (|safety_island#6| state) #b000000000 (|safety_island#1027| state))) ; $flatten\output_gate.$0\fault_q[8:0]
(define-fun |safety_island#1029| ((state |safety_island_s|)) (_ BitVec 32) (bvand (|safety_island#402| state) (concat (ite (|safety_island#418| state) #b1 #b0) (concat (ite (|safety_island#418| state) #b1 #b0) (concat (ite (|safety_island#418| state) #b1 #b0) (concat (ite (|safety_island#418| state) #b1 #b0) (concat (ite (|safety_island#418| state) #b1 #b0) (concat (ite (|safety_island#418| state) #b1 #b0) (concat (ite (|safety_island#418| state) #b1 #b0) (concat (ite (|safety_island#418| state) #b1 #b0) (concat (ite (|safety_island#418| state) #b1 #b0) (concat (ite (|safety_island#418| state) #b1 #b0) (concat (ite (|safety_island#418| state) #b1 #b0) (concat (ite (|safety_island#418| state) #b1 #b0) (concat (ite (|safety_island#418| state) #b1 #b0) (concat (ite (|safety_island#418| state) #b1 #b0) (concat (ite (|safety_island#418| state) #b1 #b0) (concat (ite (|safety_island#418| state) #b1 #b0) (concat (ite (|safety_island#418| state) #b1 #b0) (concat (ite (|safety_island#418| state) #b1 #b0) (concat (ite (|safety_island#418| state) #b1 #b0) (concat (ite (|safety_island#418| state) #b1 #b0) (concat (ite (|safety_island#418| state) #b1 #b0) (concat (ite (|safety_island#418| state) #b1 #b0) (concat (ite (|safety_island#418| state) #b1 #b0) (concat (ite (|safety_island#418| state) #b1 #b0) (concat (ite (|safety_island#418| state) #b1 #b0) (concat (ite (|safety_island#418| state) #b1 #b0) (concat (ite (|safety_island#418| state) #b1 #b0) (concat (ite (|safety_island#418| state) #b1 #b0) (concat (ite (|safety_island#418| state) #b1 #b0) (concat (ite (|safety_island#418| state) #b1 #b0) (concat (ite (|safety_island#418| state) #b1 #b0) (ite (|safety_island#418| state) #b1 #b0)))))))))))))))))))))))))))))))))) ; $flatten\stage_limits.$and$stage_limits.v:267$802_Y
(define-fun |safety_island#1030| ((state |safety_island_s|)) (_ BitVec 32) (bvor (|safety_island#415| state) (|safety_island#1029| state))) ; $flatten\stage_limits.$or$stage_limits.v:267$803_Y
(define-fun |safety_island#1031| ((state |safety_island_s|)) (_ BitVec 32) (ite (|safety_island#752| state) (|safety_island#1030| state) (|safety_island#72| state))) ; $flatten\stage_limits.$procmux$1361_Y
(define-fun |safety_island#1032| ((state |safety_island_s|)) (_ BitVec 32) (ite (|safety_island#6| state) #b00000000000000000000000000000000 (|safety_island#1031| state))) ; $flatten\stage_limits.$0\channels_q[31:0]
(define-fun |safety_island#1033| ((state |safety_island_s|)) (_ BitVec 3) (ite (|safety_island#6| state) #b000 (concat (|safety_island#57| state) (concat (|safety_island#70| state) (ite (|safety_island#421| state) #b1 #b0))))) ; { $0\cool_3_g[0:0] $0\cool_2_g[0:0] $0\cool_1_g[0:0] }
(define-fun |safety_island#1034| ((state |safety_island_s|)) (_ BitVec 14) (ite (|safety_island#170| state) #b11001111000010 ((_ extract 13 0) (|safety_island#65| state)))) ; $ternary$safety_island.v:126$245_Y
(define-fun |safety_island#1035| ((state |safety_island_s|)) (_ BitVec 14) (ite (|safety_island#48| state) (|safety_island#1034| state) (|safety_island#66| state))) ; $procmux$1533_Y
(define-fun |safety_island#1036| ((state |safety_island_s|)) (_ BitVec 14) (ite (|safety_island#6| state) #b11001111000010 (|safety_island#1035| state))) ; $0\channel_edges_q[13:0]
(define-fun |safety_island#1037| ((state |safety_island_s|)) (_ BitVec 32) (bvadd (|safety_island#59| state) #b00000000000000000000000000000001)) ; $add$safety_island_end_to_end_properties.vh:129$348_Y
(define-fun |safety_island#1038| ((state |safety_island_s|)) (_ BitVec 32) (ite (|safety_island#600| state) #b00000000000000000000000000000001 (|safety_island#1037| state))) ; $ternary$safety_island_end_to_end_properties.vh:129$349_Y
(define-fun |safety_island#1039| ((state |safety_island_s|)) (_ BitVec 32) (ite (|safety_island#728| state) #b00000000000000000000000000000000 (|safety_island#1038| state))) ; $0\beat_g[31:0]
(define-fun |safety_island#1040| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#58| state) (|safety_island#112| state) (|safety_island#51| state))) ; $procmux$1589_Y
(define-fun |safety_island#1041| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#6| state) #b0 (|safety_island#1040| state))) ; $0\armer_g[0:0]
(define-fun |safety_island#1042| ((state |safety_island_s|)) (_ BitVec 2) (ite (|safety_island#6| state) #b00 (concat ((_ extract 0 0) (|safety_island#47| state)) (ite (|safety_island#421| state) #b1 #b0)))) ; $0\temperature_ok_q[1:0]
(define-fun |safety_island#1043| ((state |safety_island_s|)) (_ BitVec 2) (ite (|safety_island#6| state) #b00 (concat ((_ extract 0 0) (|safety_island#45| state)) (ite (|safety_island#341| state) #b1 #b0)))) ; $0\run_permit_q[1:0]
(define-fun |safety_island#1044| ((state |safety_island_s|)) Bool (distinct (|safety_island#299| state) #b000000000)) ; $flatten\output_gate.$ne$output_gate.v:110$856_Y
(define-fun |safety_island#1045| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#68| state) (ite (|safety_island#1044| state) #b1 #b0) (|safety_island#42| state))) ; $flatten\output_gate.$ternary$output_gate.v:110$857_Y
(define-fun |safety_island#1046| ((state |safety_island_s|)) Bool (or  (= ((_ extract 0 0) (|safety_island#1045| state)) #b1) false  (|safety_island#305| state) false)) ; $flatten\output_gate.$logic_or$output_gate.v:110$858_Y
(define-fun |safety_island#1047| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#6| state) #b0 (ite (|safety_island#1046| state) #b1 #b0))) ; $flatten\output_gate.$0\faulted_q[0:0]
(define-fun |safety_island#1048| ((state |safety_island_s|)) Bool (and (or  (|safety_island#285| state) false) (or  (|safety_island#7| state) false))) ; $flatten\output_gate.$0\hv_enable_q[0:0]
(define-fun |safety_island#1049| ((state |safety_island_s|)) Bool (or  (|safety_island#102| state) false  (|safety_island#919| state) false)) ; $flatten\output_gate.$logic_or$output_gate.v:180$903_Y
(define-fun |safety_island#1050| ((state |safety_island_s|)) Bool (and (or  (|safety_island#1048| state) false) (or  (|safety_island#1049| state) false))) ; $flatten\output_gate.$0\focus_q[0:0]
(define-fun |safety_island#1051| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#23| state) #b0 (ite (|safety_island#1050| state) #b1 #b0))) ; $auto$rtlil.cc:3381:Mux$3245
(define-fun |safety_island#1052| ((state |safety_island_s|)) (_ BitVec 1) (bvxor (|safety_island#33| state) (ite (|safety_island#944| state) #b1 #b0))) ; $flatten\output_gate.$xor$output_gate.v:179$898_Y
(define-fun |safety_island#1053| ((state |safety_island_s|)) Bool (and (or  (|safety_island#1048| state) false) (or  (= ((_ extract 0 0) (|safety_island#1052| state)) #b1) false))) ; $flatten\output_gate.$0\hv_alive_q[0:0]
(define-fun |safety_island#1054| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#23| state) #b0 (ite (|safety_island#1053| state) #b1 #b0))) ; $auto$rtlil.cc:3381:Mux$3243
(define-fun |safety_island#1055| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#23| state) #b0 (ite (|safety_island#1048| state) #b1 #b0))) ; $auto$rtlil.cc:3381:Mux$3247
(define-fun |safety_island#1056| ((state |safety_island_s|)) Bool (not (or  (|safety_island#305| state) false))) ; $flatten\output_gate.$logic_not$output_gate.v:138$872_Y
(define-fun |safety_island#1057| ((state |safety_island_s|)) Bool (and (or  (|safety_island#48| state) false) (or  (|safety_island#1056| state) false))) ; $flatten\output_gate.$logic_and$output_gate.v:138$873_Y
(define-fun |safety_island#1058| ((state |safety_island_s|)) Bool (and (or  (|safety_island#284| state) false) (or  (|safety_island#648| state) false))) ; $flatten\output_gate.$logic_and$output_gate.v:138$876_Y
(define-fun |safety_island#1059| ((state |safety_island_s|)) Bool (or  (|safety_island#1057| state) false  (|safety_island#1058| state) false)) ; $flatten\output_gate.$logic_or$output_gate.v:138$877_Y
(define-fun |safety_island#1060| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#6| state) #b0 (ite (|safety_island#1059| state) #b1 #b0))) ; $flatten\output_gate.$0\live_q[0:0]
(define-fun |safety_island#1061| ((state |safety_island_s|)) Bool (and (or  (= ((_ extract 0 0) (|safety_island#19| state)) #b1) false) (or  (= ((_ extract 0 0) (|safety_island#55| state)) #b1) false))) ; $logic_and$safety_island_end_to_end_properties.vh:78$304_Y
(define-fun |safety_island#1062| ((state |safety_island_s|)) Bool (and (or  (|safety_island#1061| state) false) (or  (= ((_ extract 0 0) (|safety_island#57| state)) #b1) false))) ; $logic_and$safety_island_end_to_end_properties.vh:78$305_Y
(define-fun |safety_island#1063| ((state |safety_island_s|)) Bool (and (or  (|safety_island#1062| state) false) (or  (|safety_island#43| state) false))) ; $logic_and$safety_island_end_to_end_properties.vh:78$307_Y
(define-fun |safety_island#1064| ((state |safety_island_s|)) Bool (or  (|safety_island#58| state) false  (|safety_island#1063| state) false)) ; $logic_or$safety_island_end_to_end_properties.vh:78$308_Y
(define-fun |safety_island#1065| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#6| state) #b0 (ite (|safety_island#1064| state) #b1 #b0))) ; $0\allowed_g[0:0]
(define-fun |safety_island#1066| ((state |safety_island_s|)) Bool (not (or  (= ((_ extract 1 1) (|safety_island#313| state)) #b1) (= ((_ extract 2 2) (|safety_island#313| state)) #b1) (= ((_ extract 3 3) (|safety_island#313| state)) #b1) (= ((_ extract 4 4) (|safety_island#313| state)) #b1) (= ((_ extract 5 5) (|safety_island#313| state)) #b1) (= ((_ extract 6 6) (|safety_island#313| state)) #b1) (= ((_ extract 7 7) (|safety_island#313| state)) #b1) (= ((_ extract 8 8) (|safety_island#313| state)) #b1) (= ((_ extract 9 9) (|safety_island#313| state)) #b1) (= ((_ extract 10 10) (|safety_island#313| state)) #b1) (= ((_ extract 11 11) (|safety_island#313| state)) #b1) (= ((_ extract 12 12) (|safety_island#313| state)) #b1) (= ((_ extract 13 13) (|safety_island#313| state)) #b1) (= ((_ extract 14 14) (|safety_island#313| state)) #b1) (= ((_ extract 15 15) (|safety_island#313| state)) #b1) (= ((_ extract 16 16) (|safety_island#313| state)) #b1) (= ((_ extract 17 17) (|safety_island#313| state)) #b1) (= ((_ extract 18 18) (|safety_island#313| state)) #b1) (= ((_ extract 19 19) (|safety_island#313| state)) #b1) (= ((_ extract 20 20) (|safety_island#313| state)) #b1) (= ((_ extract 21 21) (|safety_island#313| state)) #b1) (= ((_ extract 22 22) (|safety_island#313| state)) #b1) (= ((_ extract 23 23) (|safety_island#313| state)) #b1) (= ((_ extract 24 24) (|safety_island#313| state)) #b1) (= ((_ extract 25 25) (|safety_island#313| state)) #b1) (= ((_ extract 26 26) (|safety_island#313| state)) #b1) (= ((_ extract 27 27) (|safety_island#313| state)) #b1) (= ((_ extract 28 28) (|safety_island#313| state)) #b1) (= ((_ extract 29 29) (|safety_island#313| state)) #b1) (= ((_ extract 30 30) (|safety_island#313| state)) #b1) (= ((_ extract 31 31) (|safety_island#313| state)) #b1)))) ; $flatten\output_gate.$eq$output_gate.v:106$853_Y
(define-fun |safety_island#1067| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#17| state)) #b1) #b1 (ite (|safety_island#1066| state) #b1 #b0))) ; $flatten\output_gate.$procmux$2353_Y
(define-fun |safety_island#1068| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#121| state) #b0 (|safety_island#1067| state))) ; $flatten\output_gate.$procmux$2356_Y
(define-fun |safety_island#1069| ((state |safety_island_s|)) (_ BitVec 1) (ite (|safety_island#6| state) #b1 (|safety_island#1068| state))) ; $flatten\output_gate.$0\silent_q[0:0]
(define-fun |safety_island#1070| ((state |safety_island_s|)) (_ BitVec 3) (ite (|safety_island#287| state) #b000 (|safety_island#11| state))) ; $flatten\output_gate.$procmux$2368_Y
(define-fun |safety_island#1071| ((state |safety_island_s|)) (_ BitVec 3) (ite (|safety_island#301| state) #b100 (|safety_island#11| state))) ; $flatten\output_gate.$procmux$2372_Y
(define-fun |safety_island#1072| ((state |safety_island_s|)) (_ BitVec 3) (ite (|safety_island#75| state) #b011 (|safety_island#11| state))) ; $flatten\output_gate.$procmux$2375_Y
(define-fun |safety_island#1073| ((state |safety_island_s|)) (_ BitVec 3) (ite (|safety_island#287| state) #b010 (|safety_island#11| state))) ; $flatten\output_gate.$procmux$2378_Y
(define-fun |safety_island#1074| ((state |safety_island_s|)) (_ BitVec 3) (ite (|safety_island#75| state) #b100 (|safety_island#1073| state))) ; $flatten\output_gate.$procmux$2381_Y
(define-fun |safety_island#1075| ((state |safety_island_s|)) Bool (not (or  (= ((_ extract 0 0) (|safety_island#300| state)) #b1) (= ((_ extract 1 1) (|safety_island#300| state)) #b1) (= ((_ extract 2 2) (|safety_island#300| state)) #b1) (= ((_ extract 3 3) (|safety_island#300| state)) #b1) (= ((_ extract 4 4) (|safety_island#300| state)) #b1) (= ((_ extract 5 5) (|safety_island#300| state)) #b1) (= ((_ extract 6 6) (|safety_island#300| state)) #b1) (= ((_ extract 7 7) (|safety_island#300| state)) #b1) (= ((_ extract 8 8) (|safety_island#300| state)) #b1) (= ((_ extract 9 9) (|safety_island#300| state)) #b1) (= ((_ extract 10 10) (|safety_island#300| state)) #b1) (= ((_ extract 11 11) (|safety_island#300| state)) #b1) (= ((_ extract 12 12) (|safety_island#300| state)) #b1) (= ((_ extract 13 13) (|safety_island#300| state)) #b1) (= ((_ extract 14 14) (|safety_island#300| state)) #b1) (= ((_ extract 15 15) (|safety_island#300| state)) #b1)))) ; $flatten\output_gate.$eq$output_gate.v:126$867_Y
(define-fun |safety_island#1076| ((state |safety_island_s|)) (_ BitVec 3) (ite (|safety_island#1075| state) #b001 (|safety_island#11| state))) ; $flatten\output_gate.$procmux$2384_Y
(define-fun |safety_island#1077| ((state |safety_island_s|)) (_ BitVec 3) (ite (|safety_island#75| state) #b000 (|safety_island#1076| state))) ; $flatten\output_gate.$procmux$2387_Y
(define-fun |safety_island#1078| ((state |safety_island_s|)) (_ BitVec 3) (ite (|safety_island#48| state) #b101 (|safety_island#11| state))) ; $flatten\output_gate.$procmux$2390_Y
(define-fun |safety_island#1079| ((state |safety_island_s|)) (_ BitVec 3) (ite (|safety_island#40| state) (|safety_island#1078| state) (ite (|safety_island#243| state) (|safety_island#1077| state) (ite (|safety_island#12| state) (|safety_island#1074| state) (ite (|safety_island#50| state) (|safety_island#1072| state) (ite (|safety_island#245| state) (|safety_island#1071| state) (ite (|safety_island#14| state) (|safety_island#1070| state) #b000))))))) ; $flatten\output_gate.$procmux$2370_Y
(define-fun |safety_island#1080| ((state |safety_island_s|)) (_ BitVec 3) (ite (|safety_island#305| state) #b000 (|safety_island#1079| state))) ; $flatten\output_gate.$procmux$2393_Y
(define-fun |safety_island#1081| ((state |safety_island_s|)) (_ BitVec 3) (ite (|safety_island#6| state) #b000 (|safety_island#1080| state))) ; $flatten\output_gate.$0\state_q[2:0]
(define-fun |safety_island#1082| ((state |safety_island_s|)) (_ BitVec 5) (ite (|safety_island#6| state) #b00000 (concat ((_ extract 3 0) (|safety_island#5| state)) #b1))) ; $0\run_g[4:0]
(define-fun |safety_island#1083| ((state |safety_island_s|)) (_ BitVec 32) (bvand (|safety_island#77| state) (|safety_island#67| state))) ; $flatten\output_gate.$and$output_gate.v:177$891_Y
(define-fun |safety_island#1084| ((state |safety_island_s|)) Bool (and (or  (|safety_island#285| state) false) (or  (= ((_ extract 2 2) (|safety_island#268| state)) #b1) false))) ; $flatten\output_gate.$logic_and$output_gate.v:177$888_Y
(define-fun |safety_island#1085| ((state |safety_island_s|)) Bool (and (or  (|safety_island#1084| state) false) (or  (|safety_island#7| state) false))) ; $flatten\output_gate.$logic_and$output_gate.v:177$890_Y
(define-fun |safety_island#1086| ((state |safety_island_s|)) (_ BitVec 32) (ite (|safety_island#1085| state) (|safety_island#1083| state) #b00000000000000000000000000000000)) ; $flatten\output_gate.$0\channel_q[31:0]
(define-fun |safety_island#1087| ((state |safety_island_s|)) (_ BitVec 32) (ite (|safety_island#23| state) #b00000000000000000000000000000000 (|safety_island#1086| state))) ; $auto$rtlil.cc:3381:Mux$3249
(define-fun |safety_island_m:W0A stage_limits.accounts| ((state |safety_island_s|)) (_ BitVec 5) (|safety_island#404| state)) ; \stage_limits.made_turn_q
(define-fun |safety_island_m:W0D stage_limits.accounts| ((state |safety_island_s|)) (_ BitVec 15) (|safety_island#369| state)) ; \stage_limits.made_q
(define-fun |safety_island_m:W0M stage_limits.accounts| ((state |safety_island_s|)) (_ BitVec 15) #b111111111111111) ; 15'111111111111111
(define-fun |safety_island#841#1| ((state |safety_island_s|)) (Array (_ BitVec 5) (_ BitVec 15)) (ite (= (|safety_island_m:W0M stage_limits.accounts| state) #b000000000000000) (|safety_island#841#0| state) (store (|safety_island#841#0| state) (|safety_island_m:W0A stage_limits.accounts| state) (bvor (bvand (|safety_island_m:W0D stage_limits.accounts| state) (|safety_island_m:W0M stage_limits.accounts| state)) (bvand (select (|safety_island#841#0| state) (|safety_island_m:W0A stage_limits.accounts| state)) (bvnot (|safety_island_m:W0M stage_limits.accounts| state))))))) ; stage_limits.accounts
(define-fun |safety_island#1088| ((state |safety_island_s|)) (_ BitVec 9) (ite (= ((_ extract 0 0) (|safety_island#401| state)) #b1) (concat (|safety_island#403| state) (|safety_island#404| state)) (|safety_island#265| state))) ; $flatten\stage_limits.$0$memwr$\made_by$stage_limits.v:208$628_ADDR[8:0]$669
(define-fun |safety_island#1089| ((state |safety_island_s|)) (_ BitVec 15) (ite (= ((_ extract 0 0) (|safety_island#401| state)) #b1) (|safety_island#369| state) (|safety_island#266| state))) ; $flatten\stage_limits.$0$memwr$\made_by$stage_limits.v:208$628_DATA[14:0]$670
(define-fun |safety_island#1090| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#401| state)) #b1) #b1 #b0)) ; $flatten\stage_limits.$0$memwr$\made_by$stage_limits.v:208$628_EN[14:0]$671 [0]
(define-fun |safety_island_m:W0A stage_limits.made_by| ((state |safety_island_s|)) (_ BitVec 9) (|safety_island#1088| state)) ; $flatten\stage_limits.$0$memwr$\made_by$stage_limits.v:208$628_ADDR[8:0]$669
(define-fun |safety_island_m:W0D stage_limits.made_by| ((state |safety_island_s|)) (_ BitVec 15) (|safety_island#1089| state)) ; $flatten\stage_limits.$0$memwr$\made_by$stage_limits.v:208$628_DATA[14:0]$670
(define-fun |safety_island_m:W0M stage_limits.made_by| ((state |safety_island_s|)) (_ BitVec 15) (concat (|safety_island#1090| state) (concat (|safety_island#1090| state) (concat (|safety_island#1090| state) (concat (|safety_island#1090| state) (concat (|safety_island#1090| state) (concat (|safety_island#1090| state) (concat (|safety_island#1090| state) (concat (|safety_island#1090| state) (concat (|safety_island#1090| state) (concat (|safety_island#1090| state) (concat (|safety_island#1090| state) (concat (|safety_island#1090| state) (concat (|safety_island#1090| state) (concat (|safety_island#1090| state) (|safety_island#1090| state)))))))))))))))) ; { $flatten\stage_limits.$0$memwr$\made_by$stage_limits.v:208$628_EN[14:0]$671 [0] $flatten\stage_limits.$0$memwr$\made_by$stage_limits.v:208$628_EN[14:0]$671 [0] $flatten\stage_limits.$0$memwr$\made_by$stage_limits.v:208$628_EN[14:0]$671 [0] $flatten\stage_limits.$0$memwr$\made_by$stage_limits.v:208$628_EN[14:0]$671 [0] $flatten\stage_limits.$0$memwr$\made_by$stage_limits.v:208$628_EN[14:0]$671 [0] $flatten\stage_limits.$0$memwr$\made_by$stage_limits.v:208$628_EN[14:0]$671 [0] $flatten\stage_limits.$0$memwr$\made_by$stage_limits.v:208$628_EN[14:0]$671 [0] $flatten\stage_limits.$0$memwr$\made_by$stage_limits.v:208$628_EN[14:0]$671 [0] $flatten\stage_limits.$0$memwr$\made_by$stage_limits.v:208$628_EN[14:0]$671 [0] $flatten\stage_limits.$0$memwr$\made_by$stage_limits.v:208$628_EN[14:0]$671 [0] $flatten\stage_limits.$0$memwr$\made_by$stage_limits.v:208$628_EN[14:0]$671 [0] $flatten\stage_limits.$0$memwr$\made_by$stage_limits.v:208$628_EN[14:0]$671 [0] $flatten\stage_limits.$0$memwr$\made_by$stage_limits.v:208$628_EN[14:0]$671 [0] $flatten\stage_limits.$0$memwr$\made_by$stage_limits.v:208$628_EN[14:0]$671 [0] $flatten\stage_limits.$0$memwr$\made_by$stage_limits.v:208$628_EN[14:0]$671 [0] }
(define-fun |safety_island#750#1| ((state |safety_island_s|)) (Array (_ BitVec 9) (_ BitVec 15)) (ite (= (|safety_island_m:W0M stage_limits.made_by| state) #b000000000000000) (|safety_island#750#0| state) (store (|safety_island#750#0| state) (|safety_island_m:W0A stage_limits.made_by| state) (bvor (bvand (|safety_island_m:W0D stage_limits.made_by| state) (|safety_island_m:W0M stage_limits.made_by| state)) (bvand (select (|safety_island#750#0| state) (|safety_island_m:W0A stage_limits.made_by| state)) (bvnot (|safety_island_m:W0M stage_limits.made_by| state))))))) ; stage_limits.made_by
(define-fun |safety_island#1091| ((state |safety_island_s|)) (_ BitVec 4) (ite (= ((_ extract 0 0) (|safety_island#378| state)) #b1) (|safety_island#412| state) (|safety_island#0| state))) ; $flatten\stage_limits.$0$memwr$\made_in$stage_limits.v:255$629_ADDR[3:0]$725
(define-fun |safety_island#1092| ((state |safety_island_s|)) (_ BitVec 21) (ite (= ((_ extract 0 0) (|safety_island#378| state)) #b1) (|safety_island#358| state) (|safety_island#1| state))) ; $flatten\stage_limits.$0$memwr$\made_in$stage_limits.v:255$629_DATA[20:0]$726
(define-fun |safety_island#1093| ((state |safety_island_s|)) (_ BitVec 1) (ite (= ((_ extract 0 0) (|safety_island#378| state)) #b1) #b1 #b0)) ; $flatten\stage_limits.$0$memwr$\made_in$stage_limits.v:255$629_EN[20:0]$727 [0]
(define-fun |safety_island_m:W0A stage_limits.made_in| ((state |safety_island_s|)) (_ BitVec 4) (|safety_island#1091| state)) ; $flatten\stage_limits.$0$memwr$\made_in$stage_limits.v:255$629_ADDR[3:0]$725
(define-fun |safety_island_m:W0D stage_limits.made_in| ((state |safety_island_s|)) (_ BitVec 21) (|safety_island#1092| state)) ; $flatten\stage_limits.$0$memwr$\made_in$stage_limits.v:255$629_DATA[20:0]$726
(define-fun |safety_island_m:W0M stage_limits.made_in| ((state |safety_island_s|)) (_ BitVec 21) (concat (|safety_island#1093| state) (concat (|safety_island#1093| state) (concat (|safety_island#1093| state) (concat (|safety_island#1093| state) (concat (|safety_island#1093| state) (concat (|safety_island#1093| state) (concat (|safety_island#1093| state) (concat (|safety_island#1093| state) (concat (|safety_island#1093| state) (concat (|safety_island#1093| state) (concat (|safety_island#1093| state) (concat (|safety_island#1093| state) (concat (|safety_island#1093| state) (concat (|safety_island#1093| state) (concat (|safety_island#1093| state) (concat (|safety_island#1093| state) (concat (|safety_island#1093| state) (concat (|safety_island#1093| state) (concat (|safety_island#1093| state) (concat (|safety_island#1093| state) (|safety_island#1093| state)))))))))))))))))))))) ; { $flatten\stage_limits.$0$memwr$\made_in$stage_limits.v:255$629_EN[20:0]$727 [0] $flatten\stage_limits.$0$memwr$\made_in$stage_limits.v:255$629_EN[20:0]$727 [0] $flatten\stage_limits.$0$memwr$\made_in$stage_limits.v:255$629_EN[20:0]$727 [0] $flatten\stage_limits.$0$memwr$\made_in$stage_limits.v:255$629_EN[20:0]$727 [0] $flatten\stage_limits.$0$memwr$\made_in$stage_limits.v:255$629_EN[20:0]$727 [0] $flatten\stage_limits.$0$memwr$\made_in$stage_limits.v:255$629_EN[20:0]$727 [0] $flatten\stage_limits.$0$memwr$\made_in$stage_limits.v:255$629_EN[20:0]$727 [0] $flatten\stage_limits.$0$memwr$\made_in$stage_limits.v:255$629_EN[20:0]$727 [0] $flatten\stage_limits.$0$memwr$\made_in$stage_limits.v:255$629_EN[20:0]$727 [0] $flatten\stage_limits.$0$memwr$\made_in$stage_limits.v:255$629_EN[20:0]$727 [0] $flatten\stage_limits.$0$memwr$\made_in$stage_limits.v:255$629_EN[20:0]$727 [0] $flatten\stage_limits.$0$memwr$\made_in$stage_limits.v:255$629_EN[20:0]$727 [0] $flatten\stage_limits.$0$memwr$\made_in$stage_limits.v:255$629_EN[20:0]$727 [0] $flatten\stage_limits.$0$memwr$\made_in$stage_limits.v:255$629_EN[20:0]$727 [0] $flatten\stage_limits.$0$memwr$\made_in$stage_limits.v:255$629_EN[20:0]$727 [0] $flatten\stage_limits.$0$memwr$\made_in$stage_limits.v:255$629_EN[20:0]$727 [0] $flatten\stage_limits.$0$memwr$\made_in$stage_limits.v:255$629_EN[20:0]$727 [0] $flatten\stage_limits.$0$memwr$\made_in$stage_limits.v:255$629_EN[20:0]$727 [0] $flatten\stage_limits.$0$memwr$\made_in$stage_limits.v:255$629_EN[20:0]$727 [0] $flatten\stage_limits.$0$memwr$\made_in$stage_limits.v:255$629_EN[20:0]$727 [0] $flatten\stage_limits.$0$memwr$\made_in$stage_limits.v:255$629_EN[20:0]$727 [0] }
(define-fun |safety_island#795#1| ((state |safety_island_s|)) (Array (_ BitVec 4) (_ BitVec 21)) (ite (= (|safety_island_m:W0M stage_limits.made_in| state) #b000000000000000000000) (|safety_island#795#0| state) (store (|safety_island#795#0| state) (|safety_island_m:W0A stage_limits.made_in| state) (bvor (bvand (|safety_island_m:W0D stage_limits.made_in| state) (|safety_island_m:W0M stage_limits.made_in| state)) (bvand (select (|safety_island#795#0| state) (|safety_island_m:W0A stage_limits.made_in| state)) (bvnot (|safety_island_m:W0M stage_limits.made_in| state))))))) ; stage_limits.made_in
(define-fun |safety_island_a| ((state |safety_island_s|)) Bool (and
  (|safety_island_a 0| state)
  (|safety_island_a 1| state)
  (|safety_island_a 2| state)
  (|safety_island_a 3| state)
  (|safety_island_a 4| state)
  (|safety_island_a 5| state)
  (|safety_island_a 6| state)
  (|safety_island_a 7| state)
  (|safety_island_a 8| state)
  (|safety_island_a 9| state)
  (|safety_island_a 10| state)
  (|safety_island_a 11| state)
  (|safety_island_a 12| state)
  (|safety_island_a 13| state)
  (|safety_island_a 14| state)
  (|safety_island_a 15| state)
  (|safety_island_a 16| state)
  (|safety_island_a 17| state)
  (|safety_island_a 18| state)
  (|safety_island_a 19| state)
  (|safety_island_a 20| state)
  (|safety_island_a 21| state)
  (|safety_island_a 22| state)
  (|safety_island_a 23| state)
  (|safety_island_a 24| state)
  (|safety_island_a 25| state)
  (|safety_island_a 26| state)
  (|safety_island_a 27| state)
  (|safety_island_a 28| state)
  (|safety_island_a 29| state)
  (|safety_island_a 30| state)
  (|safety_island_a 31| state)
  (|safety_island_a 32| state)
  (|safety_island_a 33| state)
  (|safety_island_a 34| state)
  (|safety_island_a 35| state)
  (|safety_island_a 36| state)
  (|safety_island_a 37| state)
  (|safety_island_a 38| state)
  (|safety_island_a 39| state)
  (|safety_island_a 40| state)
  (|safety_island_a 41| state)
  (|safety_island_a 42| state)
  (|safety_island_a 43| state)
  (|safety_island_a 44| state)
  (|safety_island_a 45| state)
  (|safety_island_a 46| state)
  (|safety_island_a 47| state)
  (|safety_island_a 48| state)
  (|safety_island_a 49| state)
  (|safety_island_a 50| state)
  (|safety_island_a 51| state)
  (|safety_island_a 52| state)
  (|safety_island_a 53| state)
  (|safety_island_a 54| state)
  (|safety_island_a 55| state)
  (|safety_island_a 56| state)
  (|safety_island_a 57| state)
  (|safety_island_a 58| state)
  (|safety_island_a 59| state)
  (|safety_island_a 60| state)
  (|safety_island_a 61| state)
  (|safety_island_a 62| state)
  (|safety_island_a 63| state)
  (|safety_island_a 64| state)
  (|safety_island_a 65| state)
  (|safety_island_a 66| state)
  (|safety_island_a 67| state)
  (|safety_island_a 68| state)
  (|safety_island_a 69| state)
  (|safety_island_a 70| state)
  (|safety_island_a 71| state)
  (|safety_island_a 72| state)
  (|safety_island_a 73| state)
  (|safety_island_a 74| state)
  (|safety_island_a 75| state)
  (|safety_island_a 76| state)
  (|safety_island_a 77| state)
  (|safety_island_a 78| state)
  (|safety_island_a 79| state)
  (|safety_island_a 80| state)
  (|safety_island_a 81| state)
  (|safety_island_a 82| state)
  (|safety_island_a 83| state)
  (|safety_island_a 84| state)
  (|safety_island_a 85| state)
  (|safety_island_a 86| state)
  (|safety_island_a 87| state)
  (|safety_island_a 88| state)
  (|safety_island_a 89| state)
  (|safety_island_a 90| state)
  (|safety_island_a 91| state)
  (|safety_island_a 92| state)
  (|safety_island_a 93| state)
  (|safety_island_a 94| state)
  (|safety_island_a 95| state)
  (|safety_island_a 96| state)
  (|safety_island_a 97| state)
  (|safety_island_a 98| state)
  (|safety_island_a 99| state)
  (|safety_island_a 100| state)
  (|safety_island_a 101| state)
  (|safety_island_a 102| state)
  (|safety_island_a 103| state)
  (|safety_island_a 104| state)
  (|safety_island_a 105| state)
  (|safety_island_a 106| state)
  (|safety_island_a 107| state)
  (|safety_island_a 108| state)
  (|safety_island_a 109| state)
))
(define-fun |safety_island_u| ((state |safety_island_s|)) Bool (and
  (|safety_island_u 0| state)
  (|safety_island_u 1| state)
  (|safety_island_u 2| state)
  (|safety_island_u 3| state)
  (|safety_island_u 4| state)
))
(define-fun |safety_island_i| ((state |safety_island_s|)) Bool (and
  (= (= ((_ extract 0 0) (|safety_island#22| state)) #b1) false) ; output_gate.started_q
  (= (= ((_ extract 0 0) (|safety_island#339| state)) #b1) false) ; rst_1_g
  (= (|safety_island#5| state) #b00000) ; run_g
))
(define-fun |safety_island_h| ((state |safety_island_s|)) Bool true)
(define-fun |safety_island_t| ((state |safety_island_s|) (next_state |safety_island_s|)) Bool (and
  (= (|safety_island#729| state) (|safety_island#426| next_state)) ; $procdff$2527 \up_g
  (= (|safety_island#732| state) (|safety_island#425| next_state)) ; $procdff$2512 \total_most_g
  (= (|safety_island#419| state) (|safety_island#424| next_state)) ; $procdff$2533 \total_1_q
  (= (|safety_island#735| state) (|safety_island#419| next_state)) ; $procdff$2478 \total_edges_q
  (= (|safety_island#741| state) (|safety_island#413| next_state)) ; $flatten/stage_limits.$procdff$2476 \stage_limits.parts_full_q
  (= (|safety_island#745| state) (|safety_island#412| next_state)) ; $flatten/stage_limits.$procdff$2475 \stage_limits.part_q
  (= (|safety_island#749| state) (|safety_island#409| next_state)) ; $flatten/stage_limits.$procdff$2473 \stage_limits.round_q
  (= (|safety_island#751| state) (|safety_island#407| next_state)) ; $flatten/stage_limits.$procdff$2455 \stage_limits.oldest_q
  (= (|safety_island#757| state) (|safety_island#406| next_state)) ; $flatten/stage_limits.$procdff$2415 \stage_limits.none_q
  (= (ite (|safety_island#758| state) #b1 #b0) (|safety_island#405| next_state)) ; $flatten/stage_limits.$procdff$2458 \stage_limits.new_q
  (= (|safety_island#377| state) (|safety_island#404| next_state)) ; $flatten/stage_limits.$procdff$2446 \stage_limits.made_turn_q
  (= (|safety_island#376| state) (|safety_island#403| next_state)) ; $flatten/stage_limits.$procdff$2452 \stage_limits.made_part_q
  (= (|safety_island#759| state) (|safety_island#402| next_state)) ; $flatten/stage_limits.$procdff$2459 \stage_limits.made_one_q
  (= (|safety_island#375| state) (|safety_island#401| next_state)) ; $flatten/stage_limits.$procdff$2448 \stage_limits.made_last_q
  (= (concat (|safety_island#397| state) (concat (|safety_island#395| state) (|safety_island#393| state))) (|safety_island#398| next_state)) ; $flatten/stage_limits.$procdff$2453 \stage_limits.low_1_q
  (= (|safety_island#762| state) (|safety_island#396| next_state)) ; $flatten/stage_limits.$procdff$2397 \stage_limits.low_bit[2].count_q
  (= (|safety_island#765| state) (|safety_island#394| next_state)) ; $flatten/stage_limits.$procdff$2398 \stage_limits.low_bit[1].count_q
  (= (|safety_island#767| state) (|safety_island#392| next_state)) ; $flatten/stage_limits.$procdff$2472 \stage_limits.turn_q
  (= (|safety_island#770| state) (|safety_island#391| next_state)) ; $flatten/stage_limits.$procdff$2399 \stage_limits.low_bit[0].count_q
  (= (|safety_island#775| state) (|safety_island#387| next_state)) ; $flatten/stage_limits.$procdff$2474 \stage_limits.last_round_q
  (= (|safety_island#780| state) (|safety_island#384| next_state)) ; $flatten/stage_limits.$procdff$2467 \stage_limits.soon_q
  (= (|safety_island#782| state) (|safety_island#383| next_state)) ; $flatten/stage_limits.$procdff$2471 \stage_limits.moved_q
  (= (|safety_island#785| state) (|safety_island#382| next_state)) ; $flatten/stage_limits.$procdff$2468 \stage_limits.recent_q
  (= (|safety_island#787| state) (|safety_island#379| next_state)) ; $flatten/stage_limits.$procdff$2477 \stage_limits.first_round_q
  (= (|safety_island#788| state) (|safety_island#378| next_state)) ; $flatten/stage_limits.$procdff$2402 \stage_limits.first_moves_q
  (= (|safety_island#392| state) (|safety_island#377| next_state)) ; $flatten/stage_limits.$procdff$2445 \stage_limits.fetched_q
  (= (|safety_island#412| state) (|safety_island#376| next_state)) ; $flatten/stage_limits.$procdff$2451 \stage_limits.fetched_part_q
  (= (|safety_island#387| state) (|safety_island#375| next_state)) ; $flatten/stage_limits.$procdff$2447 \stage_limits.fetched_last_q
  (= (|safety_island#413| state) (|safety_island#374| next_state)) ; $flatten/stage_limits.$procdff$2450 \stage_limits.fetched_full_q
  (= (concat (|safety_island#789| state) (|safety_island#398| state)) (|safety_island#369| next_state)) ; $flatten/stage_limits.$procdff$2456 \stage_limits.made_q
  (= (|safety_island#790| state) (|safety_island#368| next_state)) ; $flatten/stage_limits.$procdff$2470 \stage_limits.change_q
  (= (|safety_island#791| state) (|safety_island#366| next_state)) ; $flatten/stage_limits.$procdff$2469 \stage_limits.pins_q
  (= (|safety_island#792| state) (|safety_island#365| next_state)) ; $flatten/stage_limits.$procdff$2401 \stage_limits.begun_q
  (= (|safety_island#793| state) (|safety_island#364| next_state)) ; $flatten/stage_limits.$procdff$2457 \stage_limits.base_q
  (= (|safety_island#794| state) (|safety_island#362| next_state)) ; $flatten/stage_limits.$procdff$2405 \stage_limits.all_limit_q
  (= (|safety_island#799| state) (|safety_island#361| next_state)) ; $flatten/stage_limits.$procdff$2404 \stage_limits.all_base_q
  (= (|safety_island#832| state) (|safety_island#359| next_state)) ; $flatten/stage_limits.$procdff$2400 \stage_limits.moves_q
  (= (|safety_island#835| state) (|safety_island#358| next_state)) ; $flatten/stage_limits.$procdff$2403 \stage_limits.all_q
  (= (|safety_island#836| state) (|safety_island#356| next_state)) ; $flatten/stage_limits.$procdff$2407 \stage_limits.begins_q
  (= (|safety_island#840| state) (|safety_island#355| next_state)) ; $flatten/stage_limits.$procdff$2406 \stage_limits.age_q
  (= (|safety_island#379| state) (|safety_island#353| next_state)) ; $flatten/stage_limits.$procdff$2449 \stage_limits.fetched_first_q
  (= (|safety_island#842| state) (|safety_island#352| next_state)) ; $flatten/stage_limits.$procdff$2454 \stage_limits.account_q
  (= (|safety_island#850| state) (|safety_island#351| next_state)) ; $procdff$2522 \sounds_g
  (= (|safety_island#855| state) (|safety_island#350| next_state)) ; $flatten/stage_limits.$procdff$2466 \stage_limits.since_q
  (= (|safety_island#863| state) (|safety_island#349| next_state)) ; $procdff$2520 \since_g
  (= (|safety_island#864| state) (|safety_island#348| next_state)) ; $procdff$2540 \since_1_g
  (= (|safety_island#865| state) (|safety_island#343| next_state)) ; $procdff$2521 \short_g
  (= (|safety_island#83| state) (|safety_island#342| next_state)) ; $procdff$2537 \share_1_q
  (= (ite (|safety_island#6| state) #b1 #b0) (|safety_island#339| next_state)) ; $procdff$2499 \rst_1_g
  (= (|safety_island#867| state) (|safety_island#338| next_state)) ; $procdff$2518 \quiet_most_g
  (= (|safety_island#872| state) (|safety_island#337| next_state)) ; $procdff$2517 \quiet_g
  (= (|safety_island#874| state) (|safety_island#336| next_state)) ; $procdff$2486 \pulse_ticks_q
  (= (|safety_island#876| state) (|safety_island#335| next_state)) ; $procdff$2516 \pulse_least_g
  (= (|safety_island#336| state) (|safety_island#333| next_state)) ; $procdff$2536 \pulse_1_q
  (= ((_ extract 0 0) (|safety_island#877| state)) (|safety_island#330| next_state)) ; $procdff$2489 \permit_1_g
  (= (|safety_island#880| state) (|safety_island#329| next_state)) ; $procdff$2510 \patience_g
  (= (|safety_island#885| state) (|safety_island#327| next_state)) ; $procdff$2523 \owed_g
  (= (|safety_island#889| state) (|safety_island#326| next_state)) ; $flatten/output_gate.$procdff$2561 \output_gate.up_q
  (= (|safety_island#893| state) (|safety_island#325| next_state)) ; $flatten/output_gate.$procdff$2565 \output_gate.unfed_q
  (= (|safety_island#897| state) (|safety_island#324| next_state)) ; $flatten/output_gate.$procdff$2600 \output_gate.underruns_q
  (= (|safety_island#220| state) (|safety_island#319| next_state)) ; $flatten/output_gate.$procdff$2570 \output_gate.underrun_1_q
  (= (|safety_island#901| state) (|safety_island#313| next_state)) ; $flatten/output_gate.$procdff$2593 \output_gate.silence_q
  (= (|safety_island#17| state) (|safety_island#309| next_state)) ; $flatten/output_gate.$procdff$2550 \output_gate.silent_1_q
  (= (|safety_island#904| state) (|safety_island#300| next_state)) ; $flatten/output_gate.$procdff$2602 \output_gate.settle_left_q
  (= (|safety_island#909| state) (|safety_island#298| next_state)) ; $flatten/output_gate.$procdff$2597 \output_gate.rest_left_q
  (= (|safety_island#290| state) (|safety_island#294| next_state)) ; $flatten/output_gate.$procdff$2556 \output_gate.resting_1_q
  (= (|safety_island#913| state) (|safety_island#290| next_state)) ; $flatten/output_gate.$procdff$2598 \output_gate.resting_q
  (= ((_ extract 1 1) (|safety_island#45| state)) (|safety_island#286| next_state)) ; $flatten/output_gate.$procdff$2548 \output_gate.permit_1_q
  (= (|safety_island#915| state) (|safety_island#275| next_state)) ; $flatten/output_gate.$procdff$2603 \output_gate.on_later_q
  (= (|safety_island#182| state) (|safety_island#274| next_state)) ; $flatten/output_gate.$procdff$2575 \output_gate.now_1_q
  (= (|safety_island#917| state) (|safety_island#268| next_state)) ; $flatten/output_gate.$procdff$2604 \output_gate.moves_later_q
  (= (|safety_island#67| state) (|safety_island#267| next_state)) ; $flatten/output_gate.$procdff$2552 \output_gate.mask_1_q
  (= (|safety_island#30| state) (|safety_island#257| next_state)) ; $flatten/output_gate.$procdff$2555 \output_gate.hv_1_q
  (= (|safety_island#924| state) (|safety_island#255| next_state)) ; $flatten/output_gate.$procdff$2606 \output_gate.focus_left_q
  (= (|safety_island#925| state) (|safety_island#254| next_state)) ; $flatten/output_gate.$procdff$2564 \output_gate.fed_ticks_q
  (= (ite (|safety_island#927| state) #b1 #b0) (|safety_island#253| next_state)) ; $flatten/output_gate.$procdff$2566 \output_gate.fed_q
  (= ((_ extract 8 4) (|safety_island#73| state)) (|safety_island#252| next_state)) ; $flatten/output_gate.$procdff$2554 \output_gate.faults_1_q
  (= (|safety_island#106| state) (|safety_island#251| next_state)) ; $flatten/output_gate.$procdff$2574 \output_gate.fault_count_1_q
  (= (ite (|safety_island#928| state) #b1 #b0) (|safety_island#250| next_state)) ; $flatten/output_gate.$procdff$2551 \output_gate.exists_1_q
  (= (concat #b00 (concat (|safety_island#145| state) (concat (|safety_island#144| state) #b0))) (|safety_island#237| next_state)) ; $flatten/output_gate.$procdff$2546 \output_gate.edges_1_q
  (= (|safety_island#77| state) (|safety_island#236| next_state)) ; $flatten/output_gate.$procdff$2573 \output_gate.drive_1_q
  (= (ite (|safety_island#933| state) #b1 #b0) (|safety_island#233| next_state)) ; $flatten/output_gate.$procdff$2563 \output_gate.disarmed_q
  (= (ite (|safety_island#75| state) #b1 #b0) (|safety_island#227| next_state)) ; $flatten/output_gate.$procdff$2568 \output_gate.disarm_1_q
  (= ((_ extract 1 1) (|safety_island#47| state)) (|safety_island#223| next_state)) ; $flatten/output_gate.$procdff$2549 \output_gate.cool_1_q
  (= (ite (|safety_island#68| state) #b1 #b0) (|safety_island#222| next_state)) ; $flatten/output_gate.$procdff$2569 \output_gate.clear_1_q
  (= (concat (|safety_island#147| state) (concat (|safety_island#146| state) (concat (|safety_island#145| state) (concat (|safety_island#144| state) (|safety_island#143| state))))) (|safety_island#214| next_state)) ; $flatten/output_gate.$procdff$2553 \output_gate.limits_1_q
  (= (ite (|safety_island#48| state) #b1 #b0) (|safety_island#211| next_state)) ; $flatten/output_gate.$procdff$2547 \output_gate.arm_1_q
  (= (ite (|safety_island#942| state) #b1 #b0) (|safety_island#208| next_state)) ; $flatten/output_gate.$procdff$2562 \output_gate.allowed_q
  (= (|safety_island#947| state) (|safety_island#207| next_state)) ; $flatten/output_gate.$procdff$2608 \output_gate.alive_left_q
  (= (|safety_island#954| state) (|safety_island#206| next_state)) ; $flatten/output_gate.$procdff$2543 \output_gate.age_q
  (= (|safety_island#955| state) (|safety_island#205| next_state)) ; $flatten/output_gate.$procdff$2560 \output_gate.age_4_q
  (= (|safety_island#956| state) (|safety_island#204| next_state)) ; $flatten/output_gate.$procdff$2559 \output_gate.age_3_q
  (= (|safety_island#957| state) (|safety_island#203| next_state)) ; $flatten/output_gate.$procdff$2558 \output_gate.age_2_q
  (= (|safety_island#958| state) (|safety_island#202| next_state)) ; $flatten/output_gate.$procdff$2557 \output_gate.age_1_q
  (= (|safety_island#967| state) (|safety_island#198| next_state)) ; $flatten/output_gate.$procdff$2567 \output_gate.since_limit_q
  (= (ite (|safety_island#6| state) #b1 #b0) (|safety_island#195| next_state)) ; $flatten/output_gate.$procdff$2545 \output_gate.rst_1_q
  (= (concat #b0000000 (|safety_island#73| state)) (|safety_island#191| next_state)) ; $flatten/output_gate.$procdff$2572 \output_gate.all_faults_1_q
  (= (ite (|safety_island#305| state) #b1 #b0) (|safety_island#190| next_state)) ; $flatten/output_gate.$procdff$2571 \output_gate.shut_1_q
  (= (|safety_island#968| state) (|safety_island#183| next_state)) ; $procdff$2505 \off_g
  (= (|safety_island#971| state) (|safety_island#176| next_state)) ; $procdff$2525 \much_g
  (= (|safety_island#67| state) (|safety_island#168| next_state)) ; $procdff$2502 \mask_1_g
  (= ((_ extract 2 2) (|safety_island#877| state)) (|safety_island#162| next_state)) ; $procdff$2491 \permit_3_g
  (= (|safety_island#118| state) (|safety_island#159| next_state)) ; $procdff$2538 \link_1_q
  (= (ite (|safety_island#40| state) #b1 #b0) (|safety_island#154| next_state)) ; $procdff$2530 \off_1_q
  (= (ite (|safety_island#6| state) #b1 #b0) (|safety_island#148| next_state)) ; $procdff$2529 \rst_1_q
  (= (|safety_island#973| state) (|safety_island#147| next_state)) ; $flatten/stage_limits.$procdff$2413 \stage_limits.duty_q
  (= (|safety_island#974| state) (|safety_island#146| next_state)) ; $flatten/stage_limits.$procdff$2412 \stage_limits.late_q
  (= (|safety_island#976| state) (|safety_island#145| next_state)) ; $flatten/stage_limits.$procdff$2411 \stage_limits.total_edges_q
  (= (|safety_island#977| state) (|safety_island#144| next_state)) ; $flatten/stage_limits.$procdff$2410 \stage_limits.edges_q
  (= (|safety_island#979| state) (|safety_island#143| next_state)) ; $flatten/stage_limits.$procdff$2409 \stage_limits.short_q
  (= (|safety_island#980| state) (|safety_island#134| next_state)) ; $procdff$2541 \least_1_g
  (= (|safety_island#983| state) (|safety_island#133| next_state)) ; $procdff$2524 \late_g
  (= (|safety_island#30| state) (|safety_island#125| next_state)) ; $procdff$2495 \hv_1_g
  (= (|safety_island#986| state) (|safety_island#124| next_state)) ; $procdff$2482 \heartbeat_ticks_q
  (= (|safety_island#124| state) (|safety_island#122| next_state)) ; $procdff$2531 \heartbeat_1_q
  (= (|safety_island#988| state) (|safety_island#118| next_state)) ; $procdff$2481 \link_q
  (= (|safety_island#991| state) (|safety_island#116| next_state)) ; $procdff$2515 \share_g
  (= (|safety_island#42| state) (|safety_island#108| next_state)) ; $procdff$2498 \faulted_1_g
  (= (|safety_island#994| state) (|safety_island#107| next_state)) ; $flatten/output_gate.$procdff$2601 \output_gate.fault_time_q
  (= (|safety_island#997| state) (|safety_island#106| next_state)) ; $flatten/output_gate.$procdff$2599 \output_gate.fault_count_q
  (= (|safety_island#106| state) (|safety_island#105| next_state)) ; $procdff$2503 \fault_count_1_g
  (= (concat #b0000000 (|safety_island#73| state)) (|safety_island#103| next_state)) ; $procdff$2504 \fault_1_g
  (= (|safety_island#1001| state) (|safety_island#101| next_state)) ; $flatten/output_gate.$procdff$2607 \output_gate.emissions_q
  (= (|safety_island#1004| state) (|safety_island#98| next_state)) ; $procdff$2484 \emission_ticks_q
  (= (|safety_island#1007| state) (|safety_island#96| next_state)) ; $procdff$2513 \emission_most_g
  (= (|safety_island#98| state) (|safety_island#95| next_state)) ; $procdff$2534 \emission_1_q
  (= (|safety_island#1010| state) (|safety_island#94| next_state)) ; $procdff$2511 \edges_most_g
  (= (|safety_island#66| state) (|safety_island#93| next_state)) ; $procdff$2532 \edges_1_q
  (= (|safety_island#89| state) (|safety_island#89| next_state)) ; $anyconst$255 \one
  (= (ite (|safety_island#1011| state) #b1 #b0) (|safety_island#88| next_state)) ; $procdff$2542 \edge_1_g
  (= (|safety_island#1014| state) (|safety_island#85| next_state)) ; $procdff$2485 \duty_ticks_q
  (= (|safety_island#1016| state) (|safety_island#83| next_state)) ; $procdff$2487 \duty_share_q
  (= (|safety_island#1019| state) (|safety_island#81| next_state)) ; $procdff$2514 \duty_most_g
  (= (|safety_island#1025| state) (|safety_island#80| next_state)) ; $flatten/stage_limits.$procdff$2408 \stage_limits.level_q
  (= (|safety_island#85| state) (|safety_island#78| next_state)) ; $procdff$2535 \duty_1_q
  (= (|safety_island#77| state) (|safety_island#76| next_state)) ; $procdff$2501 \drive_1_g
  (= (|safety_island#1028| state) (|safety_island#73| next_state)) ; $flatten/output_gate.$procdff$2595 \output_gate.fault_q
  (= (|safety_island#1032| state) (|safety_island#72| next_state)) ; $flatten/stage_limits.$procdff$2414 \stage_limits.channels_q
  (= ((_ extract 2 2) (|safety_island#1033| state)) (|safety_island#71| next_state)) ; $procdff$2494 \cool_3_g
  (= ((_ extract 0 0) (|safety_island#1033| state)) (|safety_island#70| next_state)) ; $procdff$2492 \cool_1_g
  (= (|safety_island#1036| state) (|safety_island#66| next_state)) ; $procdff$2483 \channel_edges_q
  (= (|safety_island#791| state) (|safety_island#64| next_state)) ; $procdff$2500 \channel_1_g
  (= (|safety_island#1039| state) (|safety_island#59| next_state)) ; $procdff$2526 \beat_g
  (= ((_ extract 1 1) (|safety_island#1033| state)) (|safety_island#57| next_state)) ; $procdff$2493 \cool_2_g
  (= ((_ extract 1 1) (|safety_island#877| state)) (|safety_island#55| next_state)) ; $procdff$2490 \permit_2_g
  (= (|safety_island#1041| state) (|safety_island#51| next_state)) ; $procdff$2507 \armer_g
  (= (ite (|safety_island#48| state) #b1 #b0) (|safety_island#49| next_state)) ; $procdff$2539 \arm_1_q
  (= (|safety_island#1042| state) (|safety_island#47| next_state)) ; $procdff$2480 \temperature_ok_q
  (= (|safety_island#1043| state) (|safety_island#45| next_state)) ; $procdff$2479 \run_permit_q
  (= (|safety_island#1047| state) (|safety_island#42| next_state)) ; $flatten/output_gate.$procdff$2596 \output_gate.faulted_q
  (= (|safety_island#1051| state) (|safety_island#35| next_state)) ; $flatten/output_gate.$procdff$2588 \_witness_.anyinit_flatten_output_gate__procdff_2588
  (= (|safety_island#1054| state) (|safety_island#32| next_state)) ; $flatten/output_gate.$procdff$2591 \_witness_.anyinit_flatten_output_gate__procdff_2591
  (= (|safety_island#1055| state) (|safety_island#29| next_state)) ; $flatten/output_gate.$procdff$2585 \_witness_.anyinit_flatten_output_gate__procdff_2585
  (= #b1 (|safety_island#22| next_state)) ; $flatten/output_gate.$procdff$2544 \output_gate.started_q
  (= (|safety_island#1060| state) (|safety_island#20| next_state)) ; $flatten/output_gate.$procdff$2605 \output_gate.live_q
  (= (|safety_island#1065| state) (|safety_island#19| next_state)) ; $procdff$2519 \allowed_g
  (= (|safety_island#1069| state) (|safety_island#17| next_state)) ; $flatten/output_gate.$procdff$2594 \output_gate.silent_q
  (= (|safety_island#33| state) (|safety_island#16| next_state)) ; $procdff$2496 \alive_1_g
  (= (|safety_island#1081| state) (|safety_island#11| next_state)) ; $flatten/output_gate.$procdff$2592 \output_gate.state_q
  (= (|safety_island#1082| state) (|safety_island#5| next_state)) ; $procdff$2488 \run_g
  (= (ite (|safety_island#68| state) #b1 #b0) (|safety_island#3| next_state)) ; $procdff$2497 \clear_1_g
  (= (|safety_island#1087| state) (|safety_island#2| next_state)) ; $flatten/output_gate.$procdff$2582 \_witness_.anyinit_flatten_output_gate__procdff_2582
  (= (|safety_island#841#1| state) (|safety_island#841#0| next_state)) ; stage_limits.accounts
  (= (|safety_island#750#1| state) (|safety_island#750#0| next_state)) ; stage_limits.made_by
  (= (|safety_island#795#1| state) (|safety_island#795#0| next_state)) ; stage_limits.made_in
)) ; end of module safety_island
