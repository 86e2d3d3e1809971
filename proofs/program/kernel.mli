
type __ = Obj.t

val implb : bool -> bool -> bool

val negb : bool -> bool

type ('a, 'b) sum =
| Inl of 'a
| Inr of 'b

val fst : ('a1 * 'a2) -> 'a1

val snd : ('a1 * 'a2) -> 'a2

type comparison =
| Eq
| Lt
| Gt

val pred : int -> int



type reflect =
| ReflectT
| ReflectF

module Pos :
 sig
  val compare_cont : comparison -> Big_int_Z.big_int -> Big_int_Z.big_int -> comparison

  val compare : Big_int_Z.big_int -> Big_int_Z.big_int -> comparison
 end

module Z :
 sig
  val compare : Big_int_Z.big_int -> Big_int_Z.big_int -> comparison

  val leb : Big_int_Z.big_int -> Big_int_Z.big_int -> bool

  val ltb : Big_int_Z.big_int -> Big_int_Z.big_int -> bool

  val div : Big_int_Z.big_int -> Big_int_Z.big_int -> Big_int_Z.big_int
 end

module Option :
 sig
  val apply : ('a1 -> 'a2) -> 'a2 -> 'a1 option -> 'a2

  val bind : ('a1 -> 'a2 option) -> 'a1 option -> 'a2 option

  val map : ('a1 -> 'a2) -> 'a1 option -> 'a2 option
 end

type ('aT, 'rT) simpl_fun = 'aT -> 'rT
  (* singleton inductive, whose constructor was SimplFun *)

val fun_of_simpl : ('a1, 'a2) simpl_fun -> 'a1 -> 'a2

val addb : bool -> bool -> bool

val isSome : 'a1 option -> bool

val iffP : bool -> reflect -> reflect

val idP : bool -> reflect

type 't pred0 = 't -> bool

type 't predType = __ -> 't pred0
  (* singleton inductive, whose constructor was PredType *)

type 't pred_sort = __

type 't simpl_pred = ('t, bool) simpl_fun

val simplPred : 'a1 pred0 -> 'a1 simpl_pred

module PredOfSimpl :
 sig
  val coerce : 'a1 simpl_pred -> 'a1 pred0
 end

type 't rel = 't -> 't pred0

type 't mem_pred = 't pred0
  (* singleton inductive, whose constructor was Mem *)

val pred_of_mem : 'a1 mem_pred -> 'a1 pred_sort

val in_mem : 'a1 -> 'a1 mem_pred -> bool

val mem : 'a1 predType -> 'a1 pred_sort -> 'a1 mem_pred

module Equality :
 sig
  type 't axiom = 't -> 't -> reflect

  type 't mixin_of = { op : 't rel; mixin_of__1 : 't axiom }

  val op : 'a1 mixin_of -> 'a1 rel

  type coq_type = __ mixin_of
    (* singleton inductive, whose constructor was Pack *)

  type sort = __

  val coq_class : coq_type -> sort mixin_of
 end

val eq_op : Equality.coq_type -> Equality.sort rel

val pred1 : Equality.coq_type -> Equality.sort -> Equality.sort simpl_pred

val eqnP : int Equality.axiom

val nat_eqMixin : int Equality.mixin_of

val nat_eqType : Equality.coq_type

val addn_rec : int -> int -> int

val addn : int -> int -> int

val subn_rec : int -> int -> int

val subn : int -> int -> int

val leq : int -> int -> bool

val iter : int -> ('a1 -> 'a1) -> 'a1 -> 'a1

val muln_rec : int -> int -> int

val muln : int -> int -> int

val nat_of_bool : bool -> int

val odd : int -> bool

val size : 'a1 list -> int

val nilp : 'a1 list -> bool

val head : 'a1 -> 'a1 list -> 'a1

val behead : 'a1 list -> 'a1 list

val ncons : int -> 'a1 -> 'a1 list -> 'a1 list

val nseq : int -> 'a1 -> 'a1 list

val cat : 'a1 list -> 'a1 list -> 'a1 list

val nth : 'a1 -> 'a1 list -> int -> 'a1

val set_nth : 'a1 -> 'a1 list -> int -> 'a1 -> 'a1 list

val find : 'a1 pred0 -> 'a1 list -> int

val filter : 'a1 pred0 -> 'a1 list -> 'a1 list

val count : 'a1 pred0 -> 'a1 list -> int

val has : 'a1 pred0 -> 'a1 list -> bool

val all : 'a1 pred0 -> 'a1 list -> bool

val drop : int -> 'a1 list -> 'a1 list

val take : int -> 'a1 list -> 'a1 list

val mem_seq : Equality.coq_type -> Equality.sort list -> Equality.sort -> bool

type seq_eqclass = Equality.sort list

val pred_of_seq : Equality.coq_type -> seq_eqclass -> Equality.sort pred_sort

val seq_predType : Equality.coq_type -> Equality.sort predType

val uniq : Equality.coq_type -> Equality.sort list -> bool

val index : Equality.coq_type -> Equality.sort -> Equality.sort list -> int

val map0 : ('a1 -> 'a2) -> 'a1 list -> 'a2 list

val pmap : ('a1 -> 'a2 option) -> 'a1 list -> 'a2 list

val iota : int -> int -> int list

val foldr : ('a1 -> 'a2 -> 'a2) -> 'a2 -> 'a1 list -> 'a2

val zip : 'a1 list -> 'a2 list -> ('a1 * 'a2) list

val flatten : 'a1 list list -> 'a1 list

type matrix = Big_int_Z.big_int list list

val entry : matrix -> int -> int -> Big_int_Z.big_int

val sumZ : int list -> (int -> Big_int_Z.big_int) -> Big_int_Z.big_int

type point = Big_int_Z.big_int * Big_int_Z.big_int

val zero : point

val infinity : point

val same_point : point -> point -> bool

type state =
| Open
| Resting
| Moving

val is_resting : state -> bool

val is_moving : state -> bool

type region = { lower : point; upper : point; states : state list }

val state_of : region -> int -> state

val decide : int -> state -> region -> region

val below : point -> region -> region

val above : point -> region -> region

val ordered : point -> point -> bool

type 'leaf tree =
| Split of point * 'leaf tree * 'leaf tree
| CutFriction of point * 'leaf tree * 'leaf tree
| Branch of int * 'leaf tree * 'leaf tree
| Leaf of 'leaf

val check_boxes :
  int -> (region -> point -> point -> 'a1 -> bool) -> 'a1 tree -> region -> point -> point ->
  bool

val check_tree : int -> (region -> 'a1 -> bool) -> 'a1 tree -> region -> bool

val leaves : 'a1 tree -> region -> (region * 'a1) list

type enclosed = { size_of : int; center_a : matrix; center_b : matrix; radius_a : matrix;
                  radius_b : matrix }

val indices : enclosed -> int list

val center : enclosed -> point -> int -> int -> Big_int_Z.big_int

val radius : enclosed -> point -> int -> int -> Big_int_Z.big_int

val column_bound : enclosed -> Big_int_Z.big_int list -> point -> int -> Big_int_Z.big_int

val strict_column : enclosed -> region -> Big_int_Z.big_int list -> int -> bool

val signs_of_weights : enclosed -> region -> Big_int_Z.big_int list -> bool

val columns_at_most_zero : enclosed -> region -> Big_int_Z.big_int list -> bool

val every_column_strict : enclosed -> region -> Big_int_Z.big_int list -> bool

val some_moving_column_strict : enclosed -> region -> Big_int_Z.big_int list -> bool

val farkas : enclosed -> region -> Big_int_Z.big_int list -> bool

val strict_in_both : enclosed -> enclosed -> region -> Big_int_Z.big_int list -> int -> bool

val box_farkas : enclosed -> enclosed -> region -> Big_int_Z.big_int list -> bool

val sum_from : (int -> 'a1 -> Big_int_Z.big_int) -> int -> 'a1 list -> Big_int_Z.big_int

val all_from : (int -> 'a1 -> bool) -> int -> 'a1 list -> bool

val map_from : (int -> 'a1 -> 'a2) -> int -> 'a1 list -> 'a2 list

val remainder :
  ('a1 -> 'a1 -> Big_int_Z.big_int) -> ('a2 -> 'a2 -> Big_int_Z.big_int) -> ('a1 * 'a2) ->
  ('a1 * 'a2) -> Big_int_Z.big_int

val off_diagonal :
  ('a1 -> 'a1 -> Big_int_Z.big_int) -> ('a2 -> 'a2 -> Big_int_Z.big_int) -> ('a1 * 'a2) list ->
  Equality.sort -> ('a1 * 'a2) -> Big_int_Z.big_int

val covered :
  ('a1 -> 'a1 -> Big_int_Z.big_int) -> ('a2 -> 'a2 -> Big_int_Z.big_int) -> bool -> ('a1 * 'a2)
  list -> bool

val weighted_dot :
  Big_int_Z.big_int list -> Big_int_Z.big_int list -> Big_int_Z.big_int list ->
  Big_int_Z.big_int

val dot : Big_int_Z.big_int list -> Big_int_Z.big_int list -> Big_int_Z.big_int

type late_row = int * Big_int_Z.big_int list

val late_dot : late_row -> late_row -> Big_int_Z.big_int

type factor = { weights : Big_int_Z.big_int list; factor_rows : matrix }

val active : enclosed -> region -> int list

val weighted_entry :
  enclosed -> Big_int_Z.big_int list -> point -> int -> int -> Big_int_Z.big_int

val symmetric_part :
  enclosed -> Big_int_Z.big_int list -> point -> int -> int -> Big_int_Z.big_int

val definite_end :
  enclosed -> Big_int_Z.big_int list -> bool -> point -> region -> factor -> bool

val definite : enclosed -> Big_int_Z.big_int list -> region -> factor -> factor -> bool

val box_definite :
  enclosed -> enclosed -> region -> Big_int_Z.big_int list -> (factor * factor) ->
  (factor * factor) -> bool

val signed_part : enclosed -> point -> int -> int -> Big_int_Z.big_int

val signed_end : enclosed -> bool -> point -> (Big_int_Z.big_int * factor) -> bool

type signed_ends = (Big_int_Z.big_int * factor) * (Big_int_Z.big_int * factor)

val signed_between : enclosed -> point -> point -> signed_ends -> bool

val box_signed : enclosed -> enclosed -> region -> signed_ends -> signed_ends -> bool

type box = { inverse : matrix; unit_low : Big_int_Z.big_int; unit_high : Big_int_Z.big_int;
             width : Big_int_Z.big_int }

type uniqueness = { system_inverse : matrix; system_unit_low : Big_int_Z.big_int;
                    system_unit_high : Big_int_Z.big_int; system_rate : Big_int_Z.big_int }

val unit_entry : Big_int_Z.big_int -> int -> int -> Big_int_Z.big_int

val product_center : enclosed -> int list -> matrix -> point -> int -> int -> Big_int_Z.big_int

val product_radius : enclosed -> int list -> matrix -> point -> int -> int -> Big_int_Z.big_int

val defect :
  enclosed -> int list -> matrix -> Big_int_Z.big_int -> point -> int -> Big_int_Z.big_int

val residual :
  enclosed -> int list -> int list -> Big_int_Z.big_int list -> matrix -> point -> int ->
  Big_int_Z.big_int

val contracts :
  Big_int_Z.big_int -> Big_int_Z.big_int -> Big_int_Z.big_int -> Big_int_Z.big_int -> bool

val box_row :
  enclosed -> int list -> int list -> Big_int_Z.big_int list -> matrix -> Big_int_Z.big_int ->
  Big_int_Z.big_int -> point -> int -> bool

val box_end :
  enclosed -> int list -> int list -> Big_int_Z.big_int list -> box -> Big_int_Z.big_int ->
  point -> bool

val check_box :
  enclosed -> int list -> int list -> Big_int_Z.big_int list -> box -> point -> point -> bool

val sum_center :
  int list -> Big_int_Z.big_int list -> (int -> Big_int_Z.big_int) -> Big_int_Z.big_int

val sum_radius :
  int list -> int -> Big_int_Z.big_int list -> (int -> Big_int_Z.big_int) -> (int ->
  Big_int_Z.big_int) -> Big_int_Z.big_int -> Big_int_Z.big_int

val rate_center :
  enclosed -> int list -> Big_int_Z.big_int list -> matrix -> int -> Big_int_Z.big_int

val rate_radius :
  enclosed -> int list -> int -> Big_int_Z.big_int list -> matrix -> Big_int_Z.big_int -> int
  -> Big_int_Z.big_int

val system_center :
  enclosed -> int list -> int -> Big_int_Z.big_int list -> matrix -> Big_int_Z.big_int ->
  (Big_int_Z.big_int * Big_int_Z.big_int) -> int -> Equality.sort -> Big_int_Z.big_int

val system_radius :
  enclosed -> int list -> int -> Big_int_Z.big_int list -> matrix -> Big_int_Z.big_int ->
  Big_int_Z.big_int -> (Big_int_Z.big_int * Big_int_Z.big_int) -> int -> Equality.sort ->
  Big_int_Z.big_int

val unique_row :
  enclosed -> int list -> int -> Big_int_Z.big_int list -> matrix -> Big_int_Z.big_int ->
  Big_int_Z.big_int -> Big_int_Z.big_int -> (Big_int_Z.big_int * Big_int_Z.big_int) -> int ->
  bool

val unique_end :
  enclosed -> int list -> int -> Big_int_Z.big_int list -> uniqueness -> Big_int_Z.big_int ->
  Big_int_Z.big_int -> (Big_int_Z.big_int * Big_int_Z.big_int) -> bool

val check_unique :
  enclosed -> int list -> int -> Big_int_Z.big_int list -> uniqueness -> Big_int_Z.big_int ->
  (Big_int_Z.big_int * Big_int_Z.big_int) -> (Big_int_Z.big_int * Big_int_Z.big_int) -> bool

type isolation = { pivot : int; vector : Big_int_Z.big_int list; from_point : point;
                   to_point : point; wide_box : box; narrow_box : box; unique : uniqueness;
                   left_vector : Big_int_Z.big_int list }

type outcome =
| Solution
| NegativeX of int
| NegativeY of int

type absence = { absent_pivot : int; absent_vector : Big_int_Z.big_int list; absent_box : 
                 box; absent_left : Big_int_Z.big_int list }

val moving : enclosed -> region -> int list

val others : enclosed -> region -> Equality.sort -> Equality.sort list

val decided : enclosed -> region -> bool

val point_le : point -> point -> bool

val left_center :
  enclosed -> region -> Big_int_Z.big_int list -> Big_int_Z.big_int list -> point ->
  Big_int_Z.big_int

val left_radius :
  enclosed -> region -> int -> Big_int_Z.big_int list -> Big_int_Z.big_int list ->
  Big_int_Z.big_int -> point -> Big_int_Z.big_int

val left_negative :
  enclosed -> region -> int -> Big_int_Z.big_int list -> Big_int_Z.big_int list ->
  Big_int_Z.big_int -> point -> bool

val left_positive :
  enclosed -> region -> int -> Big_int_Z.big_int list -> Big_int_Z.big_int list ->
  Big_int_Z.big_int -> point -> bool

val row_center :
  enclosed -> region -> Big_int_Z.big_int list -> point -> int -> Big_int_Z.big_int

val row_radius :
  enclosed -> region -> int -> Big_int_Z.big_int list -> Big_int_Z.big_int -> point -> int ->
  Big_int_Z.big_int

val row_positive :
  enclosed -> region -> int -> Big_int_Z.big_int list -> Big_int_Z.big_int -> point -> int ->
  bool

val row_negative :
  enclosed -> region -> int -> Big_int_Z.big_int list -> Big_int_Z.big_int -> point -> int ->
  bool

val interval_inside : region -> isolation -> bool

val sign_change : enclosed -> region -> isolation -> bool

val isolated : enclosed -> region -> isolation -> bool

val both_ends : isolation -> (point -> bool) -> bool

val solution_signs : enclosed -> region -> isolation -> bool

val outcome_signs : enclosed -> region -> isolation -> outcome -> bool

val check_root : enclosed -> region -> isolation -> outcome -> bool

val check_absent : enclosed -> region -> absence -> bool

type pinning = { pin_pivot : int; pin_vector : Big_int_Z.big_int list; pin_box : box;
                 pin_unique : uniqueness; pin_reversed : bool }

type known = { known_from : point; known_to : point; known_support : int list;
               known_biactive : int list }

val swap : point -> point

val reversed : enclosed -> enclosed

val pinned : enclosed -> region -> pinning -> bool

val known_inside : region -> known -> bool

val check_claimed : enclosed -> region -> pinning -> known -> bool

val supports_region : enclosed -> region -> known -> bool

val check_infinite : enclosed -> region -> pinning -> bool

type interval = point * point

type yield = { yield_region : region; yield_from : point; yield_to : point }

type 'whole leaf =
| Farkas of Big_int_Z.big_int list
| Definite of Big_int_Z.big_int list * factor * factor
| Absent of absence
| Root of interval * isolation * outcome
| Claimed of interval * pinning * int
| Infinite of interval * pinning * Big_int_Z.big_int list
| Whole of 'whole
| Undecided

val extended : region -> interval -> region

val reaches : region -> interval -> bool

val window : point -> point -> region

val enclosed_order : int -> enclosed

val nothing_known : known

val known_at : known list -> int -> known

val yielded : enclosed -> known list -> (region * 'a1 leaf) -> yield option

val yields : enclosed -> known list -> 'a1 leaf tree -> region -> yield list

val undecided : 'a1 leaf tree -> region -> region list

val check_leaf :
  enclosed -> known list -> (region -> 'a1 -> bool) -> (region -> int -> Big_int_Z.big_int list
  -> bool) -> region -> 'a1 leaf -> bool

val check_cover :
  enclosed -> known list -> (region -> 'a1 -> bool) -> (region -> int -> Big_int_Z.big_int list
  -> bool) -> 'a1 leaf tree -> point -> point -> bool

val same_state : state -> state -> bool

val opposite_state : state -> state -> bool

val some_opposite : int -> region -> region -> bool

val all_same : int -> region -> region -> bool

val within : interval -> interval -> bool

val ends : region -> interval

val value_of : yield -> interval

val point_lt : point -> point -> bool

val same_solution : int -> yield -> yield -> bool

val different_solutions : int -> yield -> yield -> bool

val distinct :
  int -> point -> point -> yield list -> yield list -> yield list -> yield list option

val distinct_yields : int -> point -> point -> yield list -> yield list option

type sparse_row = (int * Big_int_Z.big_int) list

val lookup : sparse_row -> int -> Big_int_Z.big_int

val times_row : Big_int_Z.big_int -> sparse_row -> sparse_row

type form_bound = { bound_times : Big_int_Z.big_int; bound_at : Big_int_Z.big_int;
                    gram_times : Big_int_Z.big_int; gram_rows : late_row list }

val columns_from : int -> int -> sparse_row list -> sparse_row list

val transposed : sparse_row list -> sparse_row list

val doubled_rows : sparse_row list -> (int * Big_int_Z.big_int) list list

val spread : sparse_row -> Big_int_Z.big_int list

val shifted_row : Big_int_Z.big_int -> Big_int_Z.big_int -> int -> sparse_row -> sparse_row

val symmetric_rows_sparse : sparse_row list -> bool

val distance :
  Big_int_Z.big_int -> Big_int_Z.big_int list -> late_row -> late_row list -> Big_int_Z.big_int

val row_bounded :
  Big_int_Z.big_int -> Big_int_Z.big_int -> Big_int_Z.big_int -> late_row list -> int ->
  (sparse_row * late_row) -> bool

val bounded_rows : Equality.sort -> sparse_row list -> form_bound -> bool

type blocks = { free_count : int; slip_count : int; ff : sparse_row list; fs : matrix;
                sf_a : matrix; sf_b : matrix; ss_a : matrix; ss_b : matrix }

type elimination = { row_scale : Big_int_Z.big_int list; unit_of : Big_int_Z.big_int;
                     right_w : matrix; left_va : matrix; left_vb : matrix;
                     bound_c : Big_int_Z.big_int; bound_d : Big_int_Z.big_int;
                     factor_scale : Big_int_Z.big_int; stiffness_factor : late_row list }

val sparse_dot : sparse_row -> Big_int_Z.big_int list -> Big_int_Z.big_int

val norm1 : Big_int_Z.big_int list -> Big_int_Z.big_int

val row_of : matrix -> int -> Big_int_Z.big_int list

val divide_up : Big_int_Z.big_int -> Big_int_Z.big_int -> Big_int_Z.big_int

val eliminated_bound : elimination -> form_bound

val stiffness_positive : blocks -> elimination -> bool

val residual_by :
  elimination -> sparse_row list -> matrix -> matrix -> int -> Big_int_Z.big_int list

val residual_column : blocks -> elimination -> matrix -> matrix -> int -> Big_int_Z.big_int list

val table : blocks -> (int -> int -> Big_int_Z.big_int) -> matrix

val condensed_center : blocks -> elimination -> matrix -> matrix -> matrix -> matrix -> matrix

val condensed_radius :
  blocks -> elimination -> Big_int_Z.big_int list -> Big_int_Z.big_int list -> matrix

val condensed : blocks -> elimination -> enclosed

val shapes : blocks -> elimination -> bool

val check_elimination : blocks -> elimination -> bool

val mark : (int -> 'a1) -> int -> int list -> 'a1 option list -> 'a1 option list

val places : int list -> int option list

type pencil = { order : int; rows_a : sparse_row list; rows_b : sparse_row list; free : int list }

val slip : pencil -> int list

val row_a : pencil -> int -> (int * Big_int_Z.big_int) list

val row_b : pencil -> int -> (int * Big_int_Z.big_int) list

val wellformed : pencil -> bool

val free_rows_constant : pencil -> bool

val restrict : int option list -> sparse_row -> sparse_row

val blocks_by : pencil -> int option list -> int list -> blocks

val blocks_of : pencil -> blocks

type whole_factor =
| Dense of Big_int_Z.big_int list * matrix
| Late of Big_int_Z.big_int * late_row list

type whole_end = { end_scale : Big_int_Z.big_int; end_factor : whole_factor }

type whole = { whole_weights : Big_int_Z.big_int list; low_end : whole_end; high_end : whole_end }

type member = int * (sparse_row * sparse_row)

val weighted : Big_int_Z.big_int list -> int -> sparse_row -> sparse_row

val may_move : pencil -> region -> int list

val members : pencil -> Big_int_Z.big_int list -> region -> member list

val member_entry : point -> member -> member -> Big_int_Z.big_int

val member_form : Big_int_Z.big_int -> point -> member -> member -> Big_int_Z.big_int

val check_end : pencil -> Big_int_Z.big_int list -> bool -> point -> region -> whole_end -> bool

val check_whole : pencil -> region -> whole -> bool

type polynomial = Big_int_Z.big_int list

type reduction = { multiplier : Big_int_Z.big_int; quotient : polynomial; rest : polynomial }

type claim = { modulus : polynomial; claim_from : Big_int_Z.big_int;
               claim_to : Big_int_Z.big_int; claim_denominator : Big_int_Z.big_int;
               support : int list; biactive : int list; components : polynomial list;
               component_reductions : reduction list; reaction_reductions : reduction list }

val scale_poly : Big_int_Z.big_int -> polynomial -> polynomial

val add_poly : polynomial -> polynomial -> polynomial

val mul_poly : polynomial -> polynomial -> polynomial

val zero_poly : polynomial -> bool

val horner_interval :
  Big_int_Z.big_int -> Big_int_Z.big_int -> Big_int_Z.big_int -> polynomial ->
  (Big_int_Z.big_int * Big_int_Z.big_int) * Big_int_Z.big_int

val low_on :
  Big_int_Z.big_int -> Big_int_Z.big_int -> Big_int_Z.big_int -> polynomial -> Big_int_Z.big_int

val high_on :
  Big_int_Z.big_int -> Big_int_Z.big_int -> Big_int_Z.big_int -> polynomial -> Big_int_Z.big_int

val changes_sign :
  Big_int_Z.big_int -> Big_int_Z.big_int -> Big_int_Z.big_int -> polynomial -> bool

val same_poly : polynomial -> polynomial -> bool

val reduces_by : polynomial -> polynomial -> reduction -> bool

val add_multiple :
  Big_int_Z.big_int -> Big_int_Z.big_int list -> Big_int_Z.big_int list -> Big_int_Z.big_int
  list

val combine_row : polynomial list -> sparse_row -> polynomial

val row_poly : pencil -> polynomial list -> int -> polynomial

val root_interval : claim -> bool

val no_reduction : reduction

val shows_zero : claim -> polynomial -> reduction -> bool

val shows_positive : claim -> polynomial -> reduction -> bool

val shows_negative : claim -> polynomial -> reduction -> bool

val component : claim -> int -> Big_int_Z.big_int list

val reaction_poly : pencil -> claim -> int -> polynomial

val component_witness : claim -> int -> reduction

val reaction_witness : claim -> int -> reduction

val x_zero : claim -> int -> bool

val x_positive : claim -> int -> bool

val x_negative : claim -> int -> bool

val y_zero : pencil -> claim -> int -> bool

val y_positive : pencil -> claim -> int -> bool

val columns_in_order : pencil -> bool

val check_claim : pencil -> claim -> bool

type enclosed_claim = { box_support : int list; box_from : point; box_to : point;
                        box_pivot : int; box_center : Big_int_Z.big_int list;
                        right_inverse : matrix; box_width : Big_int_Z.big_int;
                        rate_width : Big_int_Z.big_int; left_null : Big_int_Z.big_int list }

val scatter :
  Big_int_Z.big_int -> sparse_row -> Big_int_Z.big_int list -> Big_int_Z.big_int list

val absolute_dot : sparse_row -> Big_int_Z.big_int list -> Big_int_Z.big_int

val at_end : point -> Big_int_Z.big_int -> Big_int_Z.big_int -> Big_int_Z.big_int

val row_at_end :
  point -> Big_int_Z.big_int list -> Big_int_Z.big_int list -> Big_int_Z.big_int list

val box_active : pencil -> enclosed_claim -> Equality.sort -> bool

val active_list : pencil -> enclosed_claim -> Equality.sort list

val pivot_removed : pencil -> enclosed_claim -> Equality.sort list

val inverse_vanishes_off : pencil -> enclosed_claim -> int list -> bool

val vanishes_elsewhere : pencil -> enclosed_claim -> bool

val margin : Big_int_Z.big_int list -> int -> Big_int_Z.big_int

val dominated :
  enclosed_claim -> int -> Big_int_Z.big_int list -> Big_int_Z.big_int -> Big_int_Z.big_int ->
  bool

val dominated_at :
  enclosed_claim -> point -> int -> Big_int_Z.big_int list -> Big_int_Z.big_int list ->
  Big_int_Z.big_int -> Big_int_Z.big_int -> Big_int_Z.big_int -> bool

val dominated_ends :
  enclosed_claim -> int -> Big_int_Z.big_int list -> Big_int_Z.big_int list ->
  Big_int_Z.big_int -> Big_int_Z.big_int -> Big_int_Z.big_int -> bool

val regular_row : pencil -> enclosed_claim -> Big_int_Z.big_int list -> int -> int -> bool

val norms : enclosed_claim -> Big_int_Z.big_int list

val widths : enclosed_claim -> Big_int_Z.big_int list

val left_times : pencil -> enclosed_claim -> (int -> sparse_row) -> Big_int_Z.big_int list

val left_value : pencil -> enclosed_claim -> (int -> sparse_row) -> Big_int_Z.big_int

val weighted_norm :
  pencil -> enclosed_claim -> Big_int_Z.big_int list -> Big_int_Z.big_int list ->
  Big_int_Z.big_int

val above_radius :
  pencil -> enclosed_claim -> Big_int_Z.big_int list -> Big_int_Z.big_int list ->
  Big_int_Z.big_int list -> Big_int_Z.big_int -> Big_int_Z.big_int -> point -> bool

val below_radius :
  pencil -> enclosed_claim -> Big_int_Z.big_int list -> Big_int_Z.big_int list ->
  Big_int_Z.big_int list -> Big_int_Z.big_int -> Big_int_Z.big_int -> point -> bool

val opposite_signs :
  pencil -> enclosed_claim -> Big_int_Z.big_int list -> Big_int_Z.big_int list ->
  Big_int_Z.big_int list -> Big_int_Z.big_int -> Big_int_Z.big_int -> bool

val determinant_changes_sign : pencil -> enclosed_claim -> Big_int_Z.big_int list -> bool

val one_root_at :
  pencil -> enclosed_claim -> Big_int_Z.big_int list -> Big_int_Z.big_int list ->
  Big_int_Z.big_int list -> Big_int_Z.big_int -> point -> bool

val one_root_between :
  pencil -> enclosed_claim -> Big_int_Z.big_int list -> Big_int_Z.big_int list ->
  Big_int_Z.big_int list -> Big_int_Z.big_int -> bool

val one_root : pencil -> enclosed_claim -> Big_int_Z.big_int list -> bool

val reaction_positive :
  pencil -> enclosed_claim -> Big_int_Z.big_int list -> point -> int -> bool

val box_signs : pencil -> enclosed_claim -> Big_int_Z.big_int list -> bool

val check_enclosed_claim : pencil -> enclosed_claim -> bool

type solution_claim =
| ExactClaim of claim
| BoxClaim of enclosed_claim

val positions : pencil -> int list -> int list

val claimed_support : solution_claim -> int list

val claimed_biactive : solution_claim -> int list

val claimed_from : solution_claim -> point

val claimed_to : solution_claim -> point

val known_of : pencil -> solution_claim -> known

val check_solution_claim : pencil -> solution_claim -> bool

val known_solutions : pencil -> solution_claim list -> known list

val check_null :
  pencil -> (int -> sparse_row) -> region -> int -> Big_int_Z.big_int list -> bool

val check_limit : pencil -> region -> int -> Big_int_Z.big_int list -> bool

val check_blocks :
  pencil -> solution_claim list -> elimination -> whole leaf tree -> point -> point -> blocks
  -> bool

val check_complete :
  pencil -> solution_claim list -> elimination -> whole leaf tree -> point -> point -> bool

val found : pencil -> solution_claim list -> whole leaf tree -> point -> point -> yield list

val left_open : whole leaf tree -> point -> point -> region list

type planar = Big_int_Z.big_int * Big_int_Z.big_int

type slip_particle = { first_dof : int; second_dof : int; tangent : planar; normal : planar;
                       sign_of : Big_int_Z.big_int; geometric_stiffness : Big_int_Z.big_int }

type system = { dofs : int; stiffness : sparse_row list; mass : sparse_row list;
                free_dofs : int list; particles : slip_particle list;
                unit_length : Big_int_Z.big_int }

type linear_form = sparse_row * sparse_row

type unknown =
| Mu
| Lambda2 of Big_int_Z.big_int * Big_int_Z.big_int

val table_row : sparse_row list -> sparse_row -> sparse_row

val pencil_of_forms : sparse_row list -> int -> linear_form list -> int list -> pencil

val free_number : system -> int

val first_dofs : system -> int list

val second_dofs : system -> int list

val moving_dofs : system -> int list

val particle : system -> int -> slip_particle

val k_row : system -> int -> (int * Big_int_Z.big_int) list

val m_row : system -> int -> (int * Big_int_Z.big_int) list

val column : system -> Equality.sort -> (int * Big_int_Z.big_int) option

val column_table : system -> (int * Big_int_Z.big_int) option list

val column_rows : system -> sparse_row list

val multiple : Big_int_Z.big_int -> sparse_row -> sparse_row

val direction : Big_int_Z.big_int -> Big_int_Z.big_int -> slip_particle -> planar

val at_both : (int -> sparse_row) -> slip_particle -> planar -> sparse_row

val force_form : system -> unknown -> int -> linear_form

val pressing_form : system -> unknown -> planar -> slip_particle -> linear_form

val inner : planar -> planar -> Big_int_Z.big_int

val unit_square : system -> Big_int_Z.big_int

val turning_numerator :
  system -> Big_int_Z.big_int -> Big_int_Z.big_int -> slip_particle -> Big_int_Z.big_int

val turning : system -> unknown -> slip_particle -> Big_int_Z.big_int

val turns_exactly : system -> unknown -> slip_particle -> bool

val sliding_row : Big_int_Z.big_int -> slip_particle -> sparse_row

val cone_form : system -> unknown -> slip_particle -> linear_form

val negative : linear_form -> linear_form

val system_forms : system -> unknown -> linear_form list

val pencil_of : system -> unknown -> pencil

val columns_in_range : system -> sparse_row list -> bool

val particle_wellformed : system -> unknown -> slip_particle -> bool

val system_wellformed : system -> unknown -> bool

val flat : system -> bool

type lifted = { motion_claim : claim; forces : polynomial list;
                force_reductions : reduction list; balance_reductions : reduction list;
                normal_reductions : reduction list; rate_reductions : reduction list;
                cone_reductions : reduction list }

val witness : reduction list -> int -> reduction

val subtract : polynomial -> polynomial -> polynomial

val v_poly : lifted -> int -> Big_int_Z.big_int list

val w_poly : lifted -> int -> Big_int_Z.big_int list

val balance_poly : system -> unknown -> lifted -> int -> polynomial

val along_poly : planar -> slip_particle -> (int -> polynomial) -> polynomial

val normal_poly : lifted -> slip_particle -> polynomial

val rate_poly : lifted -> slip_particle -> polynomial

val cone_poly : system -> unknown -> lifted -> slip_particle -> polynomial

val balanced : system -> unknown -> lifted -> int -> bool

val without_force : lifted -> int -> bool

val at_rest : lifted -> int -> bool

val dof_moves : lifted -> int -> bool

val in_support : system -> lifted -> int -> bool

val is_biactive : system -> lifted -> int -> bool

val particle_states : system -> unknown -> lifted -> int -> bool

type zero_system = { without_zero : system; zero_particles : slip_particle list }

type zero_claim = { lifted_part : lifted; opening_reductions : reduction list;
                    pressure_reductions : reduction list; sliding_reductions : reduction list;
                    right_reductions : reduction list; left_reductions : reduction list }

val zero_particle : zero_system -> int -> slip_particle

val zero_dofs : zero_system -> int list

val moving_with_zero : zero_system -> int list

val gap : zero_system -> int -> int

val right : zero_system -> int -> int

val left : zero_system -> int -> int

val frame_wellformed : zero_system -> slip_particle -> bool

val zero_wellformed : zero_system -> unknown -> bool

val with_sign : Big_int_Z.big_int -> slip_particle -> slip_particle

val sliding_poly : zero_claim -> slip_particle -> polynomial

val pressure_poly : zero_claim -> slip_particle -> polynomial

val right_poly : zero_system -> unknown -> zero_claim -> slip_particle -> polynomial

val left_poly : zero_system -> unknown -> zero_claim -> slip_particle -> polynomial

val row_state : zero_claim -> Equality.sort -> polynomial -> reduction -> bool

val zero_states : zero_system -> unknown -> zero_claim -> int -> bool

val zero_variables : zero_system -> int list -> bool

val check_zero : zero_system -> unknown -> zero_claim -> bool

type bound = (Big_int_Z.big_int * Big_int_Z.big_int) option

type mcp_row = { row_m : sparse_row; row_q : Big_int_Z.big_int; lower_bound : bound;
                 upper_bound : bound }

type mcp = mcp_row list

type mcp_point = { numerators : Big_int_Z.big_int list; denominator : Big_int_Z.big_int }

val no_row : mcp_row

val mcp_row_at : mcp -> int -> mcp_row

val bound_wellformed : bound -> bool

val row_wellformed : mcp -> mcp_row -> bool

val coordinate : mcp_point -> int -> Big_int_Z.big_int

val function_value : mcp -> mcp_point -> int -> Big_int_Z.big_int

val bounds_kept : mcp -> mcp_point -> int -> bool

val at_bound : mcp_point -> bound -> int -> bool

val row_holds : mcp -> mcp_point -> int -> bool

val check_point : mcp -> mcp_point -> bool

val mcp_wellformed : mcp -> bool

val check_mcp : mcp -> mcp_point list -> bool

type value = { value_poly : polynomial; value_from : Big_int_Z.big_int;
               value_to : Big_int_Z.big_int; value_den : Big_int_Z.big_int }

type place =
| PointAt of value
| Between of value * value
| Above of value

type near = { near_multiplier : Big_int_Z.big_int; near_power : int; near_cofactor : polynomial }

type sign_evidence =
| Identity
| Remainder of reduction
| Parts of near * point list * near

val slope_interval :
  Big_int_Z.big_int -> Big_int_Z.big_int -> Big_int_Z.big_int -> polynomial ->
  ((Big_int_Z.big_int * Big_int_Z.big_int) * Big_int_Z.big_int) * Big_int_Z.big_int

val slope_low :
  Big_int_Z.big_int -> Big_int_Z.big_int -> Big_int_Z.big_int -> polynomial -> Big_int_Z.big_int

val check_value : value -> bool

val low_of : value -> polynomial -> Big_int_Z.big_int

val power_poly : polynomial -> int -> polynomial

val factors : polynomial -> polynomial -> near -> bool

val rational : value -> bool

val positive_after : value -> polynomial -> near -> bool

val positive_before : value -> polynomial -> near -> bool

val moebius : point -> point -> polynomial -> polynomial * polynomial

val positive_on : bool -> point -> point -> polynomial -> bool

val positive_between : bool -> point -> point list -> point -> polynomial -> bool

val end_of : value -> point

val start_of : value -> point

val positive_in : place -> polynomial -> sign_evidence -> bool

val zero_in : place -> polynomial -> sign_evidence -> bool

val place_checked : place -> bool

type claimed_sign =
| IsZero
| IsPositive
| IsNegative

type signed = claimed_sign * sign_evidence

type poly_vector = polynomial list

type refutation = { row_weights : poly_vector; weight_signs : signed list;
                    column_signs : signed list }

type bound0 = { bounded : int; bound_signs : refutation }

type branch = { branch_x : poly_vector; x_signs : signed list; y_signs : signed list;
                alone_by : (int * bound0 list) option }

type reason =
| Refuted of refutation
| Solved of branch

type chain =
| Stop
| Last of reason
| Next of reason * value * reason * chain

type support_leaf = { first_value : value; first_reason : reason; further : chain }

type holding = { held_place : place; held_alone : bool }

val shows : place -> polynomial -> signed -> bool

val is_zero : signed -> bool

val is_positive : signed -> bool

val is_negative : signed -> bool

val sign_at : signed list -> int -> claimed_sign * sign_evidence

val is_free : pencil -> int -> bool

val moves : pencil -> region -> int -> bool

val rests : pencil -> region -> int -> bool

val is_active : pencil -> region -> int -> bool

val decided_region : pencil -> region -> bool

val component_of : poly_vector -> int -> Big_int_Z.big_int list

val times_entry : pencil -> int -> int -> polynomial -> polynomial

val column_poly : pencil -> poly_vector -> int -> polynomial

val check_refutation : pencil -> region -> place -> refutation -> bool

val check_branch : pencil -> region -> place -> branch -> bool

val check_bound : pencil -> region -> place -> branch -> int -> bound0 -> bool

val own_sign : bound0 -> claimed_sign * sign_evidence

val check_alone : pencil -> region -> place -> branch -> bool

val inside : region -> place -> bool

val check_reason : pencil -> region -> place -> reason -> bool

val chain_places : value -> chain -> (place * reason) list

val leaf_places : support_leaf -> (place * reason) list

val reaches_end : region -> value -> chain -> bool

val check_support : pencil -> region -> support_leaf -> bool

val holding_of : (place * reason) -> holding option

val holdings : support_leaf -> holding list

type family = region * holding

val same_value : value -> value -> bool

val ends_before : value -> value -> bool

val away : value -> place -> bool

val isolated_value : support_leaf -> holding -> value option

val yield_of : region -> value -> yield

val isolated_in : region -> support_leaf -> yield list

val families_in : region -> support_leaf -> family list

val pairs : region list -> support_leaf option list -> (region * support_leaf option) list

val check_supports : pencil -> region list -> support_leaf option list -> bool

val isolated_of : region list -> support_leaf option list -> yield list

val families_of : region list -> support_leaf option list -> family list

val open_of : region list -> support_leaf option list -> region list

val belongs : int -> yield -> family -> bool

val add_lists : ('a1 -> 'a1 -> 'a1) -> 'a1 list -> 'a1 list -> 'a1 list

val add_matrix : matrix -> matrix -> matrix

val add_series : matrix list -> matrix list -> matrix list

val scale_series : Big_int_Z.big_int -> matrix list -> matrix list

val product : sparse_row list -> matrix -> matrix

val product_series : sparse_row list -> matrix list -> matrix list

val column_of : matrix -> int -> Big_int_Z.big_int list

val columns_of : int -> matrix -> Big_int_Z.big_int list list

val cross : matrix -> matrix -> matrix

val cross_series : int -> matrix list -> matrix list -> matrix list

val squares : Big_int_Z.big_int list -> Big_int_Z.big_int

val root_bits : Big_int_Z.big_int

val refined : Big_int_Z.big_int -> Big_int_Z.big_int -> Big_int_Z.big_int

val root_above : Big_int_Z.big_int -> Big_int_Z.big_int -> Big_int_Z.big_int

val root_up : Big_int_Z.big_int -> Big_int_Z.big_int

val norm2 : Big_int_Z.big_int list -> Big_int_Z.big_int

val norms0 : matrix list -> int -> polynomial

val derivative : polynomial -> polynomial

val homogeneous :
  Big_int_Z.big_int -> Big_int_Z.big_int -> polynomial -> Big_int_Z.big_int * Big_int_Z.big_int

val substituted :
  Big_int_Z.big_int -> Big_int_Z.big_int -> Big_int_Z.big_int -> polynomial ->
  polynomial * Big_int_Z.big_int

val spread_of : polynomial -> Big_int_Z.big_int

val total : polynomial -> Big_int_Z.big_int

val constant_of : polynomial -> Big_int_Z.big_int

val chord_of : polynomial -> Big_int_Z.big_int

val spread0 : polynomial -> Big_int_Z.big_int

val poly_of : matrix list -> int -> int -> polynomial

type anchor = { anchor_center : point; anchor_unit : Big_int_Z.big_int;
                anchor_right : matrix list; anchor_left : matrix list;
                anchor_scale : Big_int_Z.big_int list }

type anchor_family = { series_z : matrix list; left_norms : polynomial list;
                       right_norms : polynomial list; drift : Big_int_Z.big_int;
                       spread_z : matrix list }

type local_entry = { local_a : Big_int_Z.big_int; local_b : Big_int_Z.big_int;
                     local_ra : Big_int_Z.big_int; local_rb : Big_int_Z.big_int }

type local_leaf =
| LocalFarkas of Big_int_Z.big_int list
| LocalDefinite of Big_int_Z.big_int list * factor * factor
| LocalAbsent of absence
| LocalRoot of isolation * outcome

val row_0 : pencil -> anchor -> int -> (int * Big_int_Z.big_int) list

val row_1 : pencil -> anchor -> int -> sparse_row

val ff_block : pencil -> (int -> sparse_row) -> sparse_row list

val fs_block : pencil -> (int -> sparse_row) -> matrix

val sf_block : pencil -> (int -> sparse_row) -> matrix

val ss_block : pencil -> (int -> sparse_row) -> matrix

val residual_series :
  anchor -> Big_int_Z.big_int -> sparse_row list -> sparse_row list -> matrix list -> matrix
  list -> matrix list

val residual_right : pencil -> anchor -> Big_int_Z.big_int -> matrix list

val residual_left : pencil -> anchor -> Big_int_Z.big_int -> matrix list

val center_series : pencil -> anchor -> Big_int_Z.big_int -> matrix list -> matrix list

val row_sum : sparse_row -> Big_int_Z.big_int

val expand_from :
  pencil -> anchor -> sparse_row list -> matrix list -> matrix list -> anchor_family

val small : pencil -> matrix list -> bool

val expand : pencil -> anchor -> anchor_family option

val radii_pencil : pencil -> (sparse_row list * sparse_row list) -> pencil

val absolute : matrix list -> matrix list

val absolute_anchor : anchor -> anchor

val widened_family :
  pencil -> anchor -> (sparse_row list * sparse_row list) -> anchor_family -> anchor_family
  option

val expand_member :
  pencil -> (sparse_row list * sparse_row list) option -> anchor -> anchor_family option

val lowered : sparse_row list -> sparse_row list -> sparse_row list

val lowered_block :
  pencil -> (pencil -> int -> sparse_row) -> (sparse_row list * sparse_row list) option ->
  sparse_row list

val interval_width : point -> point -> Big_int_Z.big_int

val offset : anchor -> point -> point -> Big_int_Z.big_int

val extent : anchor -> point -> point -> Big_int_Z.big_int

val unit_y : anchor -> point -> point -> Big_int_Z.big_int

val reach : anchor -> point -> point -> Big_int_Z.big_int

val lower_n : anchor -> form_bound -> form_bound -> point -> Big_int_Z.big_int

val lower_d : form_bound -> form_bound -> point -> Big_int_Z.big_int

val proper_interval : anchor -> form_bound -> form_bound -> point -> point -> bool

val remainder_radius :
  anchor -> form_bound -> form_bound -> point -> Big_int_Z.big_int ->
  (Big_int_Z.big_int * Big_int_Z.big_int) -> (Big_int_Z.big_int * Big_int_Z.big_int) ->
  Big_int_Z.big_int

val remainder_slope :
  anchor -> form_bound -> form_bound -> anchor_family -> point -> point -> Big_int_Z.big_int ->
  (Big_int_Z.big_int * Big_int_Z.big_int) -> (Big_int_Z.big_int * Big_int_Z.big_int) ->
  (Big_int_Z.big_int * Big_int_Z.big_int) -> (Big_int_Z.big_int * Big_int_Z.big_int) ->
  Big_int_Z.big_int

val entry_of :
  anchor -> form_bound -> form_bound -> anchor_family -> point -> point -> bool -> polynomial
  -> (Big_int_Z.big_int * Big_int_Z.big_int) -> (Big_int_Z.big_int * Big_int_Z.big_int) ->
  (Big_int_Z.big_int * Big_int_Z.big_int) -> (Big_int_Z.big_int * Big_int_Z.big_int) ->
  (Big_int_Z.big_int * Big_int_Z.big_int) -> local_entry

val rounded : Big_int_Z.big_int -> Big_int_Z.big_int -> local_entry -> local_entry

val local_entries :
  int -> anchor -> form_bound -> form_bound -> anchor_family -> point -> point -> bool ->
  Big_int_Z.big_int -> local_entry list list

val local_pencil :
  int -> anchor -> form_bound -> form_bound -> anchor_family -> point -> point -> bool ->
  Big_int_Z.big_int -> enclosed

val local_point : point -> point -> point -> point

val local_isolation : point -> point -> isolation -> isolation

val local_known : point -> point -> known -> known

val moved_leaf : point -> point -> local_leaf -> local_leaf

val wants_slopes : local_leaf -> bool

val local_region : region -> region

val check_local : enclosed -> region -> local_leaf -> bool

val check_anchored :
  int -> anchor -> form_bound -> form_bound -> anchor_family -> point -> point -> region ->
  Big_int_Z.big_int -> local_leaf -> bool

val check_anchored_claim :
  int -> anchor -> form_bound -> form_bound -> anchor_family -> point -> point -> region ->
  Big_int_Z.big_int -> pinning -> known -> bool

val check_anchored_limit :
  int -> anchor -> form_bound -> form_bound -> anchor_family -> point -> point -> region ->
  Big_int_Z.big_int -> pinning -> bool

type anchoring = { stiffness_bound : form_bound; mass_bound : form_bound;
                   anchors : (bool * anchor) list }

type varying_leaf =
| OfAnchor of int * Big_int_Z.big_int * interval * local_leaf
| OfClaim of int * Big_int_Z.big_int * interval * pinning * int
| OfLimit of int * Big_int_Z.big_int * interval * pinning * Big_int_Z.big_int list
| OfWhole of whole
| LeftOpen

val swap_pencil : pencil -> pencil

val swap_region : region -> region

val swap_isolation : isolation -> isolation

val swap_leaf : local_leaf -> local_leaf

val swap_known : known -> known

val expand_anchor : pencil -> (bool * anchor) -> anchor_family option

val no_anchor : bool * anchor

val expansions : pencil -> anchoring -> anchor_family option list

val finite_root : local_leaf -> bool

val at_anchor :
  anchoring -> anchor_family option list -> int -> region -> (bool -> anchor -> form_bound ->
  form_bound -> anchor_family -> region -> bool) -> bool

val leaf_at :
  pencil -> Big_int_Z.big_int -> local_leaf -> bool -> anchor -> form_bound -> form_bound ->
  anchor_family -> region -> bool

val claim_at :
  pencil -> Big_int_Z.big_int -> pinning -> known -> bool -> anchor -> form_bound -> form_bound
  -> anchor_family -> region -> bool

val limit_at :
  pencil -> Big_int_Z.big_int -> pinning -> Big_int_Z.big_int list -> bool -> anchor ->
  form_bound -> form_bound -> anchor_family -> region -> bool

val check_varying_leaf :
  pencil -> anchoring -> anchor_family option list -> known list -> region -> varying_leaf ->
  bool

val bounds_hold : pencil -> anchoring -> bool

val check_varying :
  pencil -> solution_claim list -> anchoring -> varying_leaf tree -> point -> point -> bool

val claim_yield : pencil -> region -> known -> yield option

val varying_yield : pencil -> solution_claim list -> (region * varying_leaf) -> yield option

val varying_found :
  pencil -> solution_claim list -> varying_leaf tree -> point -> point -> yield list

val varying_open : varying_leaf tree -> point -> point -> region list

type cover =
| Eliminated of elimination * whole leaf tree
| Anchored of anchoring * varying_leaf tree

val check_cover_of : pencil -> solution_claim list -> cover -> point -> point -> bool

val regions_found : pencil -> solution_claim list -> cover -> point -> point -> yield list

val regions_open : cover -> point -> point -> region list

val families : cover -> point -> point -> support_leaf option list -> family list

val still_open : cover -> point -> point -> support_leaf option list -> region list

val all_solutions :
  pencil -> solution_claim list -> cover -> point -> point -> support_leaf option list -> yield
  list option

val check_families :
  pencil -> solution_claim list -> cover -> point -> point -> support_leaf option list -> bool

val mixed_matrix : point -> matrix -> matrix -> matrix

val mixed : point -> enclosed -> enclosed -> enclosed

type regular = { regular_pivot : int; regular_inverse : matrix;
                 regular_units : Big_int_Z.big_int list; regular_left : Big_int_Z.big_int list;
                 regular_right : Big_int_Z.big_int list;
                 regular_widths : Big_int_Z.big_int list; regular_minus : bool }

val combine_rows : Big_int_Z.big_int list -> matrix -> Big_int_Z.big_int list

val against_right : int -> regular -> Big_int_Z.big_int list -> Big_int_Z.big_int

val against_radius : int -> regular -> Big_int_Z.big_int list -> Big_int_Z.big_int

val off_pivot :
  int -> regular -> Big_int_Z.big_int -> int -> Big_int_Z.big_int list -> Big_int_Z.big_int
  list -> Big_int_Z.big_int

val regular_row0 : int -> regular -> matrix -> matrix -> Big_int_Z.big_int -> int -> bool

val regular_rows : int -> regular -> matrix -> matrix -> Big_int_Z.big_int -> bool

val row_slack :
  int -> regular -> Big_int_Z.big_int list -> Big_int_Z.big_int list -> Big_int_Z.big_int

val regular_sign : int -> regular -> matrix -> matrix -> bool

val regular_order : enclosed -> region -> Equality.sort -> int list

val restricted : int list -> (int -> int -> Big_int_Z.big_int) -> matrix

val corner_pencil : enclosed -> enclosed -> int -> enclosed

val corner_end : region -> int -> point

val corner_center : enclosed -> enclosed -> region -> int list -> int -> matrix

val corner_radius : enclosed -> enclosed -> region -> int list -> int -> matrix

val rows_at : enclosed -> enclosed -> region -> int list -> regular -> int -> bool

val sign_at0 : enclosed -> enclosed -> region -> int list -> regular -> int -> bool

val four_corners : int list

val box_regular : enclosed -> enclosed -> region -> regular -> bool

val zero_firsts : zero_system -> int list

val zero_seconds : zero_system -> int list

val turned : slip_particle -> planar

val unit_normal : slip_particle -> planar

val three_columns : zero_system -> int -> Big_int_Z.big_int -> Big_int_Z.big_int -> sparse_row

val zero_columns : zero_system -> Equality.sort -> sparse_row

val zero_table : zero_system -> sparse_row list

val row_multiple : unknown -> Big_int_Z.big_int

val scaled_normal : unknown -> slip_particle -> planar

val zero_forms : zero_system -> unknown -> int -> linear_form list

val variable_forms : zero_system -> unknown -> linear_form list

val zero_pencil : zero_system -> unknown -> pencil

val part_plain : zero_system -> pencil

val part_friction : zero_system -> pencil

val slip_number : zero_system -> int

val half_state : zero_system -> region -> int -> state

val halves_apart : zero_system -> region -> bool

val both_halves : zero_system -> region -> bool

type critical_leaf =
| BoxFarkas of Big_int_Z.big_int list
| BoxDefinite of Big_int_Z.big_int list * (factor * factor) * (factor * factor)
| BoxRegular of regular
| BoxWhole of whole * whole
| BoxSigned of Big_int_Z.big_int * signed_ends * signed_ends
| BoxHalves

val check_parts : enclosed -> enclosed -> region -> point -> point -> critical_leaf -> bool

val freed : zero_system -> zero_system

val pencil_at : zero_system -> point -> pencil

val same_weights : zero_system -> whole -> whole -> bool

val freed_weight : zero_system -> whole -> Equality.sort -> Big_int_Z.big_int

val zero_weights : zero_system -> whole -> bool

val check_whole_leaf : zero_system -> region -> point -> point -> critical_leaf -> bool

val with_left : elimination -> (matrix * matrix) -> elimination

val condensed_parts :
  zero_system -> (elimination * (matrix * matrix)) option -> (enclosed * enclosed) option

val parts_eliminated : zero_system -> (elimination * (matrix * matrix)) option -> bool

val check_critical_leaf :
  zero_system -> (enclosed * enclosed) option -> region -> point -> point -> critical_leaf ->
  bool

val check_critical :
  zero_system -> (elimination * (matrix * matrix)) option -> critical_leaf tree -> point ->
  point -> bool

type box_anchor = { reversed_anchor : bool; plain_anchor : anchor; friction_left : matrix list }

type box_anchoring = { stiffness_below : form_bound; mass_below : form_bound;
                       box_anchors : box_anchor list }

type anchored_box_leaf =
| AboutAnchor of int * Big_int_Z.big_int * critical_leaf tree
| WithoutAnchor of critical_leaf

type part_radii = { plain_radii : (sparse_row list * sparse_row list);
                    friction_radii : (sparse_row list * sparse_row list);
                    friction_shares : Big_int_Z.big_int list; share_unit : Big_int_Z.big_int }

val widened : part_radii option -> enclosed -> enclosed

val exact_part :
  int -> Big_int_Z.big_int -> pencil -> (sparse_row list * sparse_row list) -> enclosed

val radii_of_all : int -> part_radii -> part_radii

val swapped_radii :
  (sparse_row list * sparse_row list) option -> (sparse_row list * sparse_row list) option

val friction_anchor : anchor -> matrix list -> anchor

val expand_part :
  pencil -> (sparse_row list * sparse_row list) option -> bool -> anchor -> anchor_family option

val expand_box :
  zero_system -> part_radii option -> box_anchor -> (anchor_family * anchor_family) option

val check_local_leaf :
  (region -> bool) -> enclosed -> enclosed -> region -> point -> point -> critical_leaf -> bool

val local_part :
  zero_system -> form_bound -> form_bound -> anchor -> anchor_family -> point -> point ->
  Big_int_Z.big_int -> enclosed

val check_about :
  zero_system -> part_radii option -> form_bound -> form_bound -> box_anchor ->
  (anchor_family * anchor_family) -> Big_int_Z.big_int -> region -> point -> point ->
  critical_leaf tree -> bool

val check_exact : zero_system -> part_radii -> region -> point -> point -> critical_leaf -> bool

val no_box_anchor : box_anchor

val box_expansions :
  zero_system -> part_radii option -> box_anchoring -> (anchor_family * anchor_family) option
  list

val check_anchored_box :
  zero_system -> part_radii option -> box_anchoring -> (anchor_family * anchor_family) option
  list -> region -> point -> point -> anchored_box_leaf -> bool

val both_bounded : zero_system -> part_radii option -> box_anchoring -> bool

val check_anchored_critical :
  zero_system -> part_radii option -> box_anchoring -> anchored_box_leaf tree -> point -> point
  -> bool

type presence = { presence_box : regular; presence_start : regular; presence_finish : regular }

val rest_row : enclosed -> enclosed -> region -> int -> regular -> int -> int -> bool

val positive_vector : regular -> bool

val presence_edge : enclosed -> enclosed -> region -> int -> regular -> int list -> bool

val presence_inside : enclosed -> enclosed -> region -> int -> regular -> bool

val check_presence_piece :
  (enclosed * enclosed) -> (enclosed * enclosed) -> (enclosed * enclosed) -> region -> presence
  -> bool

type presence_piece = { piece_end : point; piece_region : region; piece_anchor : int;
                        piece_grain : Big_int_Z.big_int; piece_after : point;
                        piece_before : point; piece_witness : presence }

val ends_over :
  zero_system -> part_radii option -> form_bound -> form_bound -> box_anchor ->
  (anchor_family * anchor_family) -> Big_int_Z.big_int -> point -> point -> point -> point ->
  enclosed * enclosed

val check_present :
  zero_system -> part_radii option -> form_bound -> form_bound -> box_anchor ->
  (anchor_family * anchor_family) -> Big_int_Z.big_int -> region -> point -> point -> point ->
  point -> presence -> bool

val check_piece :
  zero_system -> part_radii option -> box_anchoring -> (anchor_family * anchor_family) option
  list -> point -> presence_piece -> bool

val check_pieces :
  zero_system -> part_radii option -> box_anchoring -> (anchor_family * anchor_family) option
  list -> point -> presence_piece list -> point -> bool

val check_presence :
  zero_system -> part_radii option -> box_anchoring -> presence_piece list -> point -> point ->
  bool

val one_half : zero_system -> int list -> int -> bool

val resting_halves : zero_system -> int list -> int list

val support_pencil : zero_system -> unknown -> int list -> pencil

val check_zero_enclosed : zero_system -> unknown -> enclosed_claim -> bool

type pinned_box = { box_interval : interval; near_anchor : int; near_grain : Big_int_Z.big_int;
                    box_pinning : pinning; box_claim : enclosed_claim }

val known_box : zero_system -> unknown -> pinned_box -> known

val pinned_yield : region -> pinned_box -> yield

val pinned_alone : zero_system -> unknown -> enclosed -> region -> pinned_box -> bool

val pinned_about :
  zero_system -> unknown -> anchoring -> anchor_family option list -> region -> pinned_box ->
  bool

val check_pinned :
  zero_system -> unknown -> (region -> pinned_box -> bool) -> region -> pinned_box -> bool

val pinned_yields : region list -> pinned_box option list -> yield list

val not_pinned : region list -> pinned_box option list -> region list

val check_beside :
  zero_system -> unknown -> region list -> pinned_box option list -> (region -> pinned_box ->
  bool) -> bool

val zero_distinct :
  zero_system -> unknown -> point -> point -> yield list -> region list -> support_leaf option
  list -> yield list option

val zero_open : zero_system -> region list -> support_leaf option list -> region list

val zero_undecided : cover -> point -> point -> pinned_box option list -> region list

val check_boxes_beside :
  zero_system -> unknown -> cover -> point -> point -> pinned_box option list -> bool

val check_zero_complete :
  zero_system -> unknown -> solution_claim list -> cover -> point -> point -> pinned_box option
  list -> support_leaf option list -> bool

val zero_solutions :
  zero_system -> unknown -> solution_claim list -> cover -> point -> point -> pinned_box option
  list -> support_leaf option list -> yield list option

val zero_families :
  cover -> point -> point -> pinned_box option list -> support_leaf option list -> family list

val zero_still_open :
  zero_system -> cover -> point -> point -> pinned_box option list -> support_leaf option list
  -> region list

val row_at : pencil -> point -> int -> sparse_row

val point_pencil : pencil -> point -> pencil

val check_at_value :
  pencil -> point -> solution_claim list -> cover -> support_leaf option list -> bool

val zero_row : sparse_row -> bool

val reverse_pencil : pencil -> pencil

val check_infinity : pencil -> solution_claim list -> cover -> support_leaf option list -> bool

type rational0 = Big_int_Z.big_int * Big_int_Z.big_int

type rational_row = (int * rational0) list

type rational_pencil = { given_order : int; given_a : rational_row list;
                         given_b : rational_row list; given_free : int list }

val opposite_row : rational_row -> rational_row

val reflected : rational_pencil -> rational_pencil

type rational_quadratic = { quadratic_order : int; quadratic_a : rational_row list;
                            quadratic_b : rational_row list; quadratic_c : rational_row list }

val reflected_quadratic : rational_quadratic -> rational_quadratic

val linearized : rational_quadratic -> rational_pencil

type contact =
| NotInContact
| Sticking
| Slipping of Big_int_Z.big_int * rational0
| ZeroInContact

type given_particle = { first_of : int; second_of : int; contact_of : contact;
                        frame_tangent : (rational0 * rational0);
                        frame_normal : (rational0 * rational0);
                        into_obstacle : Big_int_Z.big_int; factor_of : rational0 }

type rational_system = { degrees : int; given_stiffness : rational_row list;
                         given_mass : rational_row list; given_particles : given_particle list }

type rational_radii = { radii_of_stiffness : rational_row list;
                        radii_of_mass : rational_row list;
                        factor_ranges : (rational0 * rational0) list }

type rational_mcp_row = { given_m : rational_row; given_q : rational0;
                          given_lower : rational0 option; given_upper : rational0 option }

type candidate = { particle_of : given_particle; gap_of : rational0 }

type load = { forces_of : rational_row; displacements_of : rational_row }

type rational_body = { body_degrees : int; body_stiffness : rational_row list;
                       candidates : candidate list; held_still : int list; loads : load list }

type problem =
| GivenPencil of rational_pencil
| GivenEigenvalue of rational_pencil
| GivenQuadratic of rational_quadratic
| GivenSystem of rational_system * unknown
| GivenMembers of rational_system * rational_radii
| GivenPlain of rational_mcp_row list
| GivenLoads of rational_body

type integral =
| PencilProblem of pencil
| SystemProblem of system * unknown
| ZeroProblem of zero_system * unknown
| PlainProblem of mcp

type scales = { entry_scale : Big_int_Z.big_int; length_scale : Big_int_Z.big_int }

val slips : given_particle -> bool

val zeroes : given_particle -> bool

val in_contact : given_particle -> bool

val sign : given_particle -> Big_int_Z.big_int

val geometric_of : given_particle -> Big_int_Z.big_int * Big_int_Z.big_int

val slipping : rational_system -> given_particle list

val with_zero : rational_system -> given_particle list

val flat_body : rational_system -> bool

val dofs_of : given_particle list -> int list

val held : rational_system -> int list

val scaled_entry : Big_int_Z.big_int -> rational0 -> Big_int_Z.big_int

val exact : Big_int_Z.big_int -> rational0 -> bool

val scaled_row : Big_int_Z.big_int -> rational_row -> (int * Big_int_Z.big_int) list

val exact_rows : Big_int_Z.big_int -> rational_row list -> bool

val long_normal : given_particle -> rational0 * rational0

val scaled_planar : scales -> (rational0 * rational0) -> planar

val exact_planar : scales -> (rational0 * rational0) -> bool

val normal_of_length : scales -> given_particle -> bool

val exact_particle : scales -> given_particle -> bool

val scaled_particle : scales -> given_particle -> slip_particle

val scaled_system : scales -> rational_system -> system

val scaled_zero_system : scales -> rational_system -> zero_system

val exact_system : scales -> rational_system -> bool

val scaled_pencil : scales -> rational_pencil -> pencil

val exact_pencil : scales -> rational_pencil -> bool

val scaled_mcp_row : scales -> rational_mcp_row -> mcp_row

val exact_mcp_row : scales -> rational_mcp_row -> bool

val scaled : scales -> problem -> integral option

val signed_pencils : problem -> (rational_pencil * rational_pencil) option

val pencil_of_integral : integral -> pencil

val complementarity : problem -> int list

type solution_set = { solutions_in : yield list; families_of_set : family list;
                      open_regions : region list }

type asserted = { asserted_from : point; asserted_to : point; asserted_support : int list;
                  asserted_biactive : int list }

type stated =
| Apart
| SticksAt of rational0
| SlipsWith of Big_int_Z.big_int
| WithoutReaction

type statement =
| EachExists of point * point * asserted list
| AllInWindow of point * point * solution_set
| AllAtInfinity of solution_set
| NoneForFriction of point * point
| OneForEachFriction of point * point
| OneMotionOfRates of point * point
| StableForFriction of point * point
| PointsSolve of mcp_point list
| InEquilibrium of rational0 * rational0 list * stated list
| BelowZero of statement
| AllOfBothSigns of point * point * solution_set * solution_set

val told_apart : solution_set -> solution_set -> bool

val is_held : rational_body -> int -> bool

val is_apart : stated -> bool

val touched : rational_body -> stated list -> int -> bool

val integral_wellformed : integral -> bool

type system_radii = { stiffness_radii : sparse_row list; mass_radii : sparse_row list;
                      factor_shares : Big_int_Z.big_int list; factor_unit : Big_int_Z.big_int }

val absolute_table : system -> sparse_row list

val part_direction : Big_int_Z.big_int -> Big_int_Z.big_int -> slip_particle -> planar

val radius_form :
  system -> sparse_row list -> Big_int_Z.big_int -> Big_int_Z.big_int -> int -> sparse_row

val radius_rows :
  system -> sparse_row list -> Big_int_Z.big_int -> Big_int_Z.big_int -> sparse_row list

val radii_of_parts : system -> system_radii -> part_radii

val radii_wellformed : system -> system_radii -> bool

val check_members_absent :
  system -> system_radii -> box_anchoring -> anchored_box_leaf tree -> point -> point -> bool

val check_members_present :
  system -> system_radii -> box_anchoring -> presence_piece list -> point -> point -> bool

val scaled_radii :
  scales -> rational_radii -> Big_int_Z.big_int list -> Big_int_Z.big_int -> system_radii

val range_in_share :
  Big_int_Z.big_int -> rational0 -> (rational0 * rational0) -> Big_int_Z.big_int -> bool

val exact_radii :
  scales -> rational_system -> rational_radii -> Big_int_Z.big_int list -> Big_int_Z.big_int ->
  bool

val check_radii_absent :
  scales -> rational_system -> rational_radii -> Big_int_Z.big_int list -> Big_int_Z.big_int ->
  box_anchoring -> anchored_box_leaf tree -> point -> point -> bool

val check_radii_present :
  scales -> rational_system -> rational_radii -> Big_int_Z.big_int list -> Big_int_Z.big_int ->
  box_anchoring -> presence_piece list -> point -> point -> bool

type equilibrium_evidence =
| ExactAt of Big_int_Z.big_int list
| BoxAround of Big_int_Z.big_int list * matrix * Big_int_Z.big_int

val dominated_row :
  polynomial list -> Big_int_Z.big_int list -> Big_int_Z.big_int -> int -> sparse_row -> bool

val check_rows : int -> sparse_row list -> sparse_row list -> equilibrium_evidence -> bool

val times_rational : rational0 -> rational0 -> rational0

val scaled_by : rational0 -> rational_row -> rational_row

val negated : rational_row -> rational_row

val constant : rational_body -> rational0 -> rational_row

val applied_row :
  rational_body -> rational0 list -> (load -> rational_row) -> int -> rational_row

val displacement_row : int -> rational_row

val reaction_row : rational_body -> rational0 list -> int -> (int * rational0) list

val tangential_row : given_particle -> (int -> rational_row) -> (int * rational0) list

val normal_row : given_particle -> (int -> rational_row) -> rational_row

val pressure_row : rational_body -> rational0 list -> given_particle -> rational_row

val bound_row : rational_body -> rational0 -> rational0 list -> given_particle -> rational_row

val equations_at :
  rational_body -> rational0 list -> stated list -> int -> (int * rational0) list list

val state_equations :
  rational_body -> rational0 -> rational0 list -> candidate -> stated -> (int * rational0) list
  list

val state_inequalities :
  rational_body -> rational0 -> rational0 list -> candidate -> stated -> (int * rational0) list
  list

val of_candidates :
  rational_body -> stated list -> (candidate -> stated -> rational_row list) -> rational_row
  list

val equations :
  rational_body -> rational0 -> rational0 list -> stated list -> (int * rational0) list list

val inequalities :
  rational_body -> rational0 -> rational0 list -> stated list -> rational_row list

val positive_rational : rational0 -> bool

val lawful : (candidate * stated) -> bool

val well_stated : rational_body -> rational0 -> rational0 list -> stated list -> bool

val check_equilibrium :
  rational_body -> rational0 -> rational0 list -> stated list -> Big_int_Z.big_int ->
  equilibrium_evidence -> bool

val check_rates :
  system -> (Big_int_Z.big_int * Big_int_Z.big_int) -> point -> elimination -> signed_ends ->
  bool

val check_given_rates :
  scales -> rational_system -> (Big_int_Z.big_int * Big_int_Z.big_int) -> point -> elimination
  -> signed_ends -> bool

type stable_end = { end_form : matrix; end_slope : Big_int_Z.big_int list;
                    end_unit : Big_int_Z.big_int; end_times : Big_int_Z.big_int;
                    end_gram : Big_int_Z.big_int; end_rows : late_row list }

type stability = { gain : matrix; gain_unit : Big_int_Z.big_int; mass_form : form_bound;
                   turn : point; wide : point; root : point }

val mu_pencil : system -> pencil

val mass_pencil : system -> pencil

val friction_pencil : system -> pencil

val length_of : system -> int -> Big_int_Z.big_int

val symmetric_form : system -> sparse_row list -> sparse_row list

val k_rows : system -> sparse_row list

val m_rows : system -> sparse_row list

val corrected_row :
  stability -> sparse_row list -> sparse_row -> Big_int_Z.big_int list -> sparse_row

val corrected_at :
  system -> stability -> sparse_row list -> sparse_row list -> int -> sparse_row

val sum_abs : sparse_row -> Big_int_Z.big_int

val sumZ_of : ('a1 -> Big_int_Z.big_int) -> 'a1 list -> Big_int_Z.big_int

val turned_in :
  system -> stability -> sparse_row list -> sparse_row list -> Big_int_Z.big_int list

val kappa_in :
  system -> stability -> sparse_row list -> sparse_row list -> point -> Big_int_Z.big_int

val form_vector : system -> elimination -> stability -> int -> Big_int_Z.big_int list

val form_rest : elimination -> stability -> blocks -> int -> Big_int_Z.big_int list

val form_size : system -> elimination -> stability -> blocks -> int -> Big_int_Z.big_int

val width_bound : system -> elimination -> blocks -> Big_int_Z.big_int

val check_turn :
  system -> stability -> sparse_row list -> sparse_row list -> Big_int_Z.big_int list -> point
  -> bool

val check_wide : system -> elimination -> stability -> blocks -> bool

val check_root0 : Big_int_Z.big_int -> system -> elimination -> stability -> bool

val check_shapes :
  system -> stability -> (int * Big_int_Z.big_int) list list -> (int * Big_int_Z.big_int) list
  list -> (int * Big_int_Z.big_int) list list -> (int * Big_int_Z.big_int) list list -> bool

val drag_times : stability -> Big_int_Z.big_int list -> point -> int -> Big_int_Z.big_int

val below0 :
  Big_int_Z.big_int -> system -> elimination -> stability -> enclosed -> Big_int_Z.big_int list
  -> point -> stable_end -> int -> int -> bool

val steep :
  Big_int_Z.big_int -> system -> elimination -> stability -> Big_int_Z.big_int list ->
  Big_int_Z.big_int list -> point -> stable_end -> int -> bool

val form_entry : stable_end -> int -> int -> Big_int_Z.big_int

val check_end0 :
  Big_int_Z.big_int -> system -> elimination -> stability -> enclosed -> Big_int_Z.big_int list
  -> Big_int_Z.big_int list -> point -> stable_end -> bool

val check_stable :
  Big_int_Z.big_int -> system -> elimination -> stability -> point -> point -> stable_end ->
  stable_end -> bool

val check_given_stable :
  scales -> rational_system -> elimination -> stability -> point -> point -> stable_end ->
  stable_end -> bool

val zero_yield : yield -> bool

val zero_family : family -> bool

val nonzero_values : solution_set -> solution_set

type claim_evidence =
| OfPencil of solution_claim
| OfMotion of zero_claim
| OfZeroBox of enclosed_claim

type cover_evidence =
| CoverInWindow of solution_claim list * cover * pinned_box option list
   * support_leaf option list
| CoverAtValue of solution_claim list * cover * support_leaf option list

type absence_evidence =
| ByElimination of (elimination * (matrix * matrix)) option * critical_leaf tree
| ByAnchors of box_anchoring * anchored_box_leaf tree

type evidence =
| ClaimsIn of point * point * claim_evidence list
| CoverOf of point * point * cover_evidence
| CoverAtInfinity of solution_claim list * cover * support_leaf option list
| Absence of point * point * absence_evidence
| Presence of point * point * box_anchoring * presence_piece list
| MembersAbsence of point * point * Big_int_Z.big_int list * Big_int_Z.big_int * box_anchoring
   * anchored_box_leaf tree
| MembersPresence of point * point * Big_int_Z.big_int list * Big_int_Z.big_int * box_anchoring
   * presence_piece list
| DefiniteRates of point * point * elimination * signed_ends
| Stable of point * point * elimination * stability * stable_end * stable_end
| Points of mcp_point list
| Equilibrium of rational0 * rational0 list * stated list * equilibrium_evidence
| Reflected of evidence
| OfBothSigns of evidence * evidence

type answered =
| Proved of statement
| ClaimRefused of int
| EvidenceRefused
| NotToldApart

val asserted_of : solution_claim -> asserted

val asserted_motion : zero_claim -> asserted

val claim_answer : integral -> pencil -> claim_evidence -> asserted option

val in_window : point -> point -> asserted -> bool

val all_asserted :
  integral -> pencil -> point -> point -> int -> claim_evidence list -> (asserted list, int) sum

val claims_answer : integral -> pencil -> point -> point -> claim_evidence list -> answered

val answer_claims : integral -> point -> point -> claim_evidence list -> answered

val told : yield list option -> (yield list -> statement) -> answered

val answer_cover : pencil -> point -> point -> cover_evidence -> answered

val answer_zero_cover : zero_system -> unknown -> point -> point -> cover_evidence -> answered

val answer_infinity :
  pencil -> solution_claim list -> cover -> support_leaf option list -> answered

val check_absence : zero_system -> point -> point -> absence_evidence -> bool

val zero_system_of : integral -> zero_system option

val proved_if : bool -> statement -> answered

val integral_answer : integral -> evidence -> answered

val scaled_answer : problem -> scales -> evidence -> answered

val below_zero : answered -> answered

val joined : answered -> answered -> answered

val signed_answer : rational_pencil -> rational_pencil -> scales -> evidence -> answered

val answer : problem -> scales -> evidence -> answered
