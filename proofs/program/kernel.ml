
type __ = Obj.t
let __ = let rec f _ = Obj.repr f in Obj.repr f

(** val implb : bool -> bool -> bool **)

let implb b1 b2 =
  if b1 then b2 else true

(** val negb : bool -> bool **)

let negb = function
| true -> false
| false -> true

type ('a, 'b) sum =
| Inl of 'a
| Inr of 'b

(** val fst : ('a1 * 'a2) -> 'a1 **)

let fst = function
| (x, _) -> x

(** val snd : ('a1 * 'a2) -> 'a2 **)

let snd = function
| (_, y) -> y

type comparison =
| Eq
| Lt
| Gt

(** val pred : int -> int **)

let pred n =
  (fun zero next n -> if n = 0 then zero () else next (Natural.before n))
    (fun _ -> n)
    (fun u -> u)
    n



type reflect =
| ReflectT
| ReflectF

module Pos =
 struct
  (** val compare_cont : comparison -> Big_int_Z.big_int -> Big_int_Z.big_int -> comparison **)

  let rec compare_cont = (fun c x y -> let s = Big_int_Z.compare_big_int x y in
  if s = 0 then c else if s < 0 then Lt else Gt)

  (** val compare : Big_int_Z.big_int -> Big_int_Z.big_int -> comparison **)

  let compare = (fun x y -> let s = Big_int_Z.compare_big_int x y in
  if s = 0 then Eq else if s < 0 then Lt else Gt)
 end

module Z =
 struct
  (** val compare : Big_int_Z.big_int -> Big_int_Z.big_int -> comparison **)

  let compare = (fun x y -> let s = Big_int_Z.compare_big_int x y in
  if s = 0 then Eq else if s < 0 then Lt else Gt)

  (** val leb : Big_int_Z.big_int -> Big_int_Z.big_int -> bool **)

  let leb x y =
    match compare x y with
    | Gt -> false
    | _ -> true

  (** val ltb : Big_int_Z.big_int -> Big_int_Z.big_int -> bool **)

  let ltb x y =
    match compare x y with
    | Lt -> true
    | _ -> false

  (** val div : Big_int_Z.big_int -> Big_int_Z.big_int -> Big_int_Z.big_int **)

  let div = Big_int_Z.(fun x y ->
  match sign_big_int y with
  | 0 -> zero_big_int
  | 1 -> div_big_int x y
  | _ -> add_int_big_int (-1) (div_big_int (add_int_big_int (-1) x) y))
 end

module Option =
 struct
  (** val apply : ('a1 -> 'a2) -> 'a2 -> 'a1 option -> 'a2 **)

  let apply f x = function
  | Some y -> f y
  | None -> x

  (** val bind : ('a1 -> 'a2 option) -> 'a1 option -> 'a2 option **)

  let bind f =
    apply f None

  (** val map : ('a1 -> 'a2) -> 'a1 option -> 'a2 option **)

  let map f =
    bind (fun x -> Some (f x))
 end

type ('aT, 'rT) simpl_fun = 'aT -> 'rT
  (* singleton inductive, whose constructor was SimplFun *)

(** val fun_of_simpl : ('a1, 'a2) simpl_fun -> 'a1 -> 'a2 **)

let fun_of_simpl f =
  f

(** val addb : bool -> bool -> bool **)

let addb = function
| true -> negb
| false -> (fun x -> x)

(** val isSome : 'a1 option -> bool **)

let isSome = function
| Some _ -> true
| None -> false

(** val iffP : bool -> reflect -> reflect **)

let iffP _ pb =
  let _evar_0_ = fun _ _ _ -> ReflectT in
  let _evar_0_0 = fun _ _ _ -> ReflectF in
  (match pb with
   | ReflectT -> _evar_0_ __ __ __
   | ReflectF -> _evar_0_0 __ __ __)

(** val idP : bool -> reflect **)

let idP = function
| true -> ReflectT
| false -> ReflectF

type 't pred0 = 't -> bool

type 't predType = __ -> 't pred0
  (* singleton inductive, whose constructor was PredType *)

type 't pred_sort = __

type 't simpl_pred = ('t, bool) simpl_fun

(** val simplPred : 'a1 pred0 -> 'a1 simpl_pred **)

let simplPred p =
  p

module PredOfSimpl =
 struct
  (** val coerce : 'a1 simpl_pred -> 'a1 pred0 **)

  let coerce =
    fun_of_simpl
 end

type 't rel = 't -> 't pred0

type 't mem_pred = 't pred0
  (* singleton inductive, whose constructor was Mem *)

(** val pred_of_mem : 'a1 mem_pred -> 'a1 pred_sort **)

let pred_of_mem mp =
  Obj.magic mp

(** val in_mem : 'a1 -> 'a1 mem_pred -> bool **)

let in_mem x mp =
  Obj.magic pred_of_mem mp x

(** val mem : 'a1 predType -> 'a1 pred_sort -> 'a1 mem_pred **)

let mem pT =
  pT

module Equality =
 struct
  type 't axiom = 't -> 't -> reflect

  type 't mixin_of = { op : 't rel; mixin_of__1 : 't axiom }

  (** val op : 'a1 mixin_of -> 'a1 rel **)

  let op m =
    m.op

  type coq_type = __ mixin_of
    (* singleton inductive, whose constructor was Pack *)

  type sort = __

  (** val coq_class : coq_type -> sort mixin_of **)

  let coq_class cT =
    cT
 end

(** val eq_op : Equality.coq_type -> Equality.sort rel **)

let eq_op t =
  (Equality.coq_class t).Equality.op

(** val pred1 : Equality.coq_type -> Equality.sort -> Equality.sort simpl_pred **)

let pred1 t a1 =
  simplPred (fun x -> eq_op t x a1)

(** val eqnP : int Equality.axiom **)

let eqnP n m =
  iffP ((fun (a : int) (b : int) -> a = b) n m) (idP ((fun (a : int) (b : int) -> a = b) n m))

(** val nat_eqMixin : int Equality.mixin_of **)

let nat_eqMixin =
  { Equality.op = (fun (a : int) (b : int) -> a = b); Equality.mixin_of__1 = eqnP }

(** val nat_eqType : Equality.coq_type **)

let nat_eqType =
  Obj.magic nat_eqMixin

(** val addn_rec : int -> int -> int **)

let addn_rec =
  Natural.add

(** val addn : int -> int -> int **)

let addn =
  addn_rec

(** val subn_rec : int -> int -> int **)

let subn_rec =
  Natural.sub

(** val subn : int -> int -> int **)

let subn =
  subn_rec

(** val leq : int -> int -> bool **)

let leq m n =
  eq_op nat_eqType (Obj.magic subn m n) (Obj.magic 0)

(** val iter : int -> ('a1 -> 'a1) -> 'a1 -> 'a1 **)

let rec iter n f x =
  (fun zero next n -> if n = 0 then zero () else next (Natural.before n))
    (fun _ -> x)
    (fun i -> f (iter i f x))
    n

(** val muln_rec : int -> int -> int **)

let muln_rec =
  Natural.mul

(** val muln : int -> int -> int **)

let muln =
  muln_rec

(** val nat_of_bool : bool -> int **)

let nat_of_bool = function
| true -> Natural.succ 0
| false -> 0

(** val odd : int -> bool **)

let rec odd n =
  (fun zero next n -> if n = 0 then zero () else next (Natural.before n))
    (fun _ -> false)
    (fun n' -> negb (odd n'))
    n

(** val size : 'a1 list -> int **)

let rec size = function
| [] -> 0
| _ :: s' -> Natural.succ (size s')

(** val nilp : 'a1 list -> bool **)

let nilp s =
  eq_op nat_eqType (Obj.magic size s) (Obj.magic 0)

(** val head : 'a1 -> 'a1 list -> 'a1 **)

let head x0 = function
| [] -> x0
| x :: _ -> x

(** val behead : 'a1 list -> 'a1 list **)

let behead = function
| [] -> []
| _ :: s' -> s'

(** val ncons : int -> 'a1 -> 'a1 list -> 'a1 list **)

let ncons n x =
  iter n (fun x0 -> x :: x0)

(** val nseq : int -> 'a1 -> 'a1 list **)

let nseq n x =
  ncons n x []

(** val cat : 'a1 list -> 'a1 list -> 'a1 list **)

let rec cat s1 s2 =
  match s1 with
  | [] -> s2
  | x :: s1' -> x :: (cat s1' s2)

(** val nth : 'a1 -> 'a1 list -> int -> 'a1 **)

let rec nth x0 s n =
  match s with
  | [] -> x0
  | x :: s' ->
    ((fun zero next n -> if n = 0 then zero () else next (Natural.before n))
       (fun _ -> x)
       (fun n' -> nth x0 s' n')
       n)

(** val set_nth : 'a1 -> 'a1 list -> int -> 'a1 -> 'a1 list **)

let rec set_nth x0 s n y =
  match s with
  | [] -> ncons n x0 (y :: [])
  | x :: s' ->
    ((fun zero next n -> if n = 0 then zero () else next (Natural.before n))
       (fun _ -> y :: s')
       (fun n' -> x :: (set_nth x0 s' n' y))
       n)

(** val find : 'a1 pred0 -> 'a1 list -> int **)

let rec find a = function
| [] -> 0
| x :: s' -> if a x then 0 else Natural.succ (find a s')

(** val filter : 'a1 pred0 -> 'a1 list -> 'a1 list **)

let rec filter a = function
| [] -> []
| x :: s' -> if a x then x :: (filter a s') else filter a s'

(** val count : 'a1 pred0 -> 'a1 list -> int **)

let rec count a = function
| [] -> 0
| x :: s' -> addn (nat_of_bool (a x)) (count a s')

(** val has : 'a1 pred0 -> 'a1 list -> bool **)

let rec has a = function
| [] -> false
| x :: s' -> (||) (a x) (has a s')

(** val all : 'a1 pred0 -> 'a1 list -> bool **)

let rec all a = function
| [] -> true
| x :: s' -> (&&) (a x) (all a s')

(** val drop : int -> 'a1 list -> 'a1 list **)

let rec drop n s = match s with
| [] -> s
| _ :: s' ->
  ((fun zero next n -> if n = 0 then zero () else next (Natural.before n))
     (fun _ -> s)
     (fun n' -> drop n' s')
     n)

(** val take : int -> 'a1 list -> 'a1 list **)

let rec take n = function
| [] -> []
| x :: s' ->
  ((fun zero next n -> if n = 0 then zero () else next (Natural.before n))
     (fun _ -> [])
     (fun n' -> x :: (take n' s'))
     n)

(** val mem_seq : Equality.coq_type -> Equality.sort list -> Equality.sort -> bool **)

let rec mem_seq t = function
| [] -> (fun _ -> false)
| y :: s' -> let p = mem_seq t s' in (fun x -> (||) (eq_op t x y) (p x))

type seq_eqclass = Equality.sort list

(** val pred_of_seq : Equality.coq_type -> seq_eqclass -> Equality.sort pred_sort **)

let pred_of_seq t s =
  Obj.magic mem_seq t s

(** val seq_predType : Equality.coq_type -> Equality.sort predType **)

let seq_predType t =
  Obj.magic pred_of_seq t

(** val uniq : Equality.coq_type -> Equality.sort list -> bool **)

let rec uniq t = function
| [] -> true
| x :: s' -> (&&) (negb (in_mem x (mem (seq_predType t) (Obj.magic s')))) (uniq t s')

(** val index : Equality.coq_type -> Equality.sort -> Equality.sort list -> int **)

let index t x =
  find (PredOfSimpl.coerce (pred1 t x))

(** val map0 : ('a1 -> 'a2) -> 'a1 list -> 'a2 list **)

let rec map0 f = function
| [] -> []
| x :: s' -> (f x) :: (map0 f s')

(** val pmap : ('a1 -> 'a2 option) -> 'a1 list -> 'a2 list **)

let rec pmap f = function
| [] -> []
| x :: s' -> let r = pmap f s' in Option.apply (fun x0 -> x0 :: r) r (f x)

(** val iota : int -> int -> int list **)

let rec iota m n =
  (fun zero next n -> if n = 0 then zero () else next (Natural.before n))
    (fun _ -> [])
    (fun n' -> m :: (iota (Natural.succ m) n'))
    n

(** val foldr : ('a1 -> 'a2 -> 'a2) -> 'a2 -> 'a1 list -> 'a2 **)

let rec foldr f z0 = function
| [] -> z0
| x :: s' -> f x (foldr f z0 s')

(** val zip : 'a1 list -> 'a2 list -> ('a1 * 'a2) list **)

let rec zip s t =
  match s with
  | [] -> []
  | x :: s' -> (match t with
                | [] -> []
                | y :: t' -> (x, y) :: (zip s' t'))

(** val flatten : 'a1 list list -> 'a1 list **)

let flatten s =
  foldr cat [] s

type matrix = Big_int_Z.big_int list list

(** val entry : matrix -> int -> int -> Big_int_Z.big_int **)

let entry m i j =
  nth Big_int_Z.zero_big_int (nth [] m i) j

(** val sumZ : int list -> (int -> Big_int_Z.big_int) -> Big_int_Z.big_int **)

let sumZ l f =
  foldr (fun i a -> Big_int_Z.add_big_int (f i) a) Big_int_Z.zero_big_int l

type point = Big_int_Z.big_int * Big_int_Z.big_int

(** val zero : point **)

let zero =
  (Big_int_Z.zero_big_int, Big_int_Z.unit_big_int)

(** val infinity : point **)

let infinity =
  (Big_int_Z.unit_big_int, Big_int_Z.zero_big_int)

(** val same_point : point -> point -> bool **)

let same_point a b =
  (&&) (Big_int_Z.eq_big_int (fst a) (fst b)) (Big_int_Z.eq_big_int (snd a) (snd b))

type state =
| Open
| Resting
| Moving

(** val is_resting : state -> bool **)

let is_resting = function
| Resting -> true
| _ -> false

(** val is_moving : state -> bool **)

let is_moving = function
| Moving -> true
| _ -> false

type region = { lower : point; upper : point; states : state list }

(** val state_of : region -> int -> state **)

let state_of r i =
  nth Open r.states i

(** val decide : int -> state -> region -> region **)

let decide i s r =
  { lower = r.lower; upper = r.upper; states = (set_nth Open r.states i s) }

(** val below : point -> region -> region **)

let below t r =
  { lower = r.lower; upper = t; states = r.states }

(** val above : point -> region -> region **)

let above t r =
  { lower = t; upper = r.upper; states = r.states }

(** val ordered : point -> point -> bool **)

let ordered lo hi =
  (&&) (Z.leb Big_int_Z.zero_big_int (fst lo))
    ((&&) (Z.ltb Big_int_Z.zero_big_int (snd lo))
      ((&&) (Z.leb Big_int_Z.zero_big_int (fst hi))
        ((&&) (Z.leb Big_int_Z.zero_big_int (snd hi))
          ((&&) (Z.ltb Big_int_Z.zero_big_int (Big_int_Z.add_big_int (fst hi) (snd hi)))
            (Z.leb (Big_int_Z.mult_big_int (fst lo) (snd hi))
              (Big_int_Z.mult_big_int (fst hi) (snd lo)))))))

type 'leaf tree =
| Split of point * 'leaf tree * 'leaf tree
| CutFriction of point * 'leaf tree * 'leaf tree
| Branch of int * 'leaf tree * 'leaf tree
| Leaf of 'leaf

(** val check_boxes :
    int -> (region -> point -> point -> 'a1 -> bool) -> 'a1 tree -> region -> point -> point ->
    bool **)

let rec check_boxes n evidence0 tr r low high =
  match tr with
  | Split (t, tr1, tr2) ->
    (&&) (ordered r.lower t)
      ((&&) (ordered t r.upper)
        ((&&) (check_boxes n evidence0 tr1 (below t r) low high)
          (check_boxes n evidence0 tr2 (above t r) low high)))
  | CutFriction (m, tr1, tr2) ->
    (&&) (ordered low m)
      ((&&) (ordered m high)
        ((&&) (check_boxes n evidence0 tr1 r low m) (check_boxes n evidence0 tr2 r m high)))
  | Branch (i, tr1, tr2) ->
    (&&) (leq (Natural.succ i) n)
      ((&&) (check_boxes n evidence0 tr1 (decide i Resting r) low high)
        (check_boxes n evidence0 tr2 (decide i Moving r) low high))
  | Leaf l -> (&&) (ordered r.lower r.upper) ((&&) (ordered low high) (evidence0 r low high l))

(** val check_tree : int -> (region -> 'a1 -> bool) -> 'a1 tree -> region -> bool **)

let check_tree n evidence0 tr r =
  check_boxes n (fun r' _ _ -> evidence0 r') tr r zero zero

(** val leaves : 'a1 tree -> region -> (region * 'a1) list **)

let rec leaves tr r =
  match tr with
  | Split (t, tr1, tr2) -> cat (leaves tr1 (below t r)) (leaves tr2 (above t r))
  | CutFriction (_, tr1, tr2) -> cat (leaves tr1 r) (leaves tr2 r)
  | Branch (i, tr1, tr2) ->
    cat (leaves tr1 (decide i Resting r)) (leaves tr2 (decide i Moving r))
  | Leaf l -> (r, l) :: []

type enclosed = { size_of : int; center_a : matrix; center_b : matrix; radius_a : matrix;
                  radius_b : matrix }

(** val indices : enclosed -> int list **)

let indices p =
  iota 0 p.size_of

(** val center : enclosed -> point -> int -> int -> Big_int_Z.big_int **)

let center p e i j =
  Big_int_Z.add_big_int (Big_int_Z.mult_big_int (snd e) (entry p.center_a i j))
    (Big_int_Z.mult_big_int (fst e) (entry p.center_b i j))

(** val radius : enclosed -> point -> int -> int -> Big_int_Z.big_int **)

let radius p e i j =
  Big_int_Z.add_big_int (Big_int_Z.mult_big_int (snd e) (entry p.radius_a i j))
    (Big_int_Z.mult_big_int (fst e) (entry p.radius_b i j))

(** val column_bound :
    enclosed -> Big_int_Z.big_int list -> point -> int -> Big_int_Z.big_int **)

let column_bound p w e j =
  sumZ (indices p) (fun i ->
    Big_int_Z.add_big_int
      (Big_int_Z.mult_big_int (nth Big_int_Z.zero_big_int w i) (center p e i j))
      (Big_int_Z.mult_big_int (Big_int_Z.abs_big_int (nth Big_int_Z.zero_big_int w i))
        (radius p e i j)))

(** val strict_column : enclosed -> region -> Big_int_Z.big_int list -> int -> bool **)

let strict_column p r w j =
  (&&) (Z.ltb (column_bound p w r.lower j) Big_int_Z.zero_big_int)
    ((||) (Big_int_Z.eq_big_int (snd r.upper) Big_int_Z.zero_big_int)
      (Z.ltb (column_bound p w r.upper j) Big_int_Z.zero_big_int))

(** val signs_of_weights : enclosed -> region -> Big_int_Z.big_int list -> bool **)

let signs_of_weights p r w =
  all (fun i ->
    (||) (is_moving (state_of r i))
      (Z.leb Big_int_Z.zero_big_int (nth Big_int_Z.zero_big_int w i))) (indices p)

(** val columns_at_most_zero : enclosed -> region -> Big_int_Z.big_int list -> bool **)

let columns_at_most_zero p r w =
  all (fun j ->
    (||) (is_resting (state_of r j))
      ((&&) (Z.leb (column_bound p w r.lower j) Big_int_Z.zero_big_int)
        (Z.leb (column_bound p w r.upper j) Big_int_Z.zero_big_int))) (indices p)

(** val every_column_strict : enclosed -> region -> Big_int_Z.big_int list -> bool **)

let every_column_strict p r w =
  all (fun j -> (||) (is_resting (state_of r j)) (strict_column p r w j)) (indices p)

(** val some_moving_column_strict : enclosed -> region -> Big_int_Z.big_int list -> bool **)

let some_moving_column_strict p r w =
  has (fun j -> (&&) (is_moving (state_of r j)) (strict_column p r w j)) (indices p)

(** val farkas : enclosed -> region -> Big_int_Z.big_int list -> bool **)

let farkas p r w =
  (&&) (signs_of_weights p r w)
    ((&&) (columns_at_most_zero p r w)
      ((||) (every_column_strict p r w) (some_moving_column_strict p r w)))

(** val strict_in_both :
    enclosed -> enclosed -> region -> Big_int_Z.big_int list -> int -> bool **)

let strict_in_both p p' r w j =
  (&&) (strict_column p r w j) (strict_column p' r w j)

(** val box_farkas : enclosed -> enclosed -> region -> Big_int_Z.big_int list -> bool **)

let box_farkas p p' r w =
  (&&) (signs_of_weights p r w)
    ((&&) (columns_at_most_zero p r w)
      ((&&) (columns_at_most_zero p' r w)
        ((||)
          (all (fun j -> (||) (is_resting (state_of r j)) (strict_in_both p p' r w j))
            (indices p))
          (has (fun j -> (&&) (is_moving (state_of r j)) (strict_in_both p p' r w j))
            (indices p)))))

(** val sum_from : (int -> 'a1 -> Big_int_Z.big_int) -> int -> 'a1 list -> Big_int_Z.big_int **)

let rec sum_from f k = function
| [] -> Big_int_Z.zero_big_int
| x :: l' -> Big_int_Z.add_big_int (f k x) (sum_from f (Natural.succ k) l')

(** val all_from : (int -> 'a1 -> bool) -> int -> 'a1 list -> bool **)

let rec all_from f k = function
| [] -> true
| x :: l' -> (&&) (f k x) (all_from f (Natural.succ k) l')

(** val map_from : (int -> 'a1 -> 'a2) -> int -> 'a1 list -> 'a2 list **)

let rec map_from f k = function
| [] -> []
| x :: l' -> (f k x) :: (map_from f (Natural.succ k) l')

(** val remainder :
    ('a1 -> 'a1 -> Big_int_Z.big_int) -> ('a2 -> 'a2 -> Big_int_Z.big_int) -> ('a1 * 'a2) ->
    ('a1 * 'a2) -> Big_int_Z.big_int **)

let remainder s product0 a b =
  Big_int_Z.sub_big_int (s (fst a) (fst b)) (product0 (snd a) (snd b))

(** val off_diagonal :
    ('a1 -> 'a1 -> Big_int_Z.big_int) -> ('a2 -> 'a2 -> Big_int_Z.big_int) -> ('a1 * 'a2) list
    -> Equality.sort -> ('a1 * 'a2) -> Big_int_Z.big_int **)

let off_diagonal s product0 rows i a =
  sum_from (fun j b ->
    if eq_op nat_eqType (Obj.magic j) i
    then Big_int_Z.zero_big_int
    else Big_int_Z.abs_big_int (remainder s product0 a b)) 0 rows

(** val covered :
    ('a1 -> 'a1 -> Big_int_Z.big_int) -> ('a2 -> 'a2 -> Big_int_Z.big_int) -> bool ->
    ('a1 * 'a2) list -> bool **)

let covered s product0 strict rows =
  all_from (fun i a ->
    if strict
    then Z.ltb (off_diagonal s product0 rows (Obj.magic i) a) (remainder s product0 a a)
    else Z.leb (off_diagonal s product0 rows (Obj.magic i) a) (remainder s product0 a a)) 0 rows

(** val weighted_dot :
    Big_int_Z.big_int list -> Big_int_Z.big_int list -> Big_int_Z.big_int list ->
    Big_int_Z.big_int **)

let rec weighted_dot w a b =
  match w with
  | [] -> Big_int_Z.zero_big_int
  | u :: w' ->
    (match a with
     | [] -> Big_int_Z.zero_big_int
     | x :: a' ->
       (match b with
        | [] -> Big_int_Z.zero_big_int
        | y :: b' ->
          Big_int_Z.add_big_int (Big_int_Z.mult_big_int u (Big_int_Z.mult_big_int x y))
            (weighted_dot w' a' b')))

(** val dot : Big_int_Z.big_int list -> Big_int_Z.big_int list -> Big_int_Z.big_int **)

let rec dot a b =
  match a with
  | [] -> Big_int_Z.zero_big_int
  | x :: a' ->
    (match b with
     | [] -> Big_int_Z.zero_big_int
     | y :: b' -> Big_int_Z.add_big_int (Big_int_Z.mult_big_int x y) (dot a' b'))

type late_row = int * Big_int_Z.big_int list

(** val late_dot : late_row -> late_row -> Big_int_Z.big_int **)

let late_dot a b =
  if leq (fst a) (fst b)
  then dot (drop (subn (fst b) (fst a)) (snd a)) (snd b)
  else dot (snd a) (drop (subn (fst a) (fst b)) (snd b))

type factor = { weights : Big_int_Z.big_int list; factor_rows : matrix }

(** val active : enclosed -> region -> int list **)

let active p r =
  filter (fun i -> negb (is_resting (state_of r i))) (indices p)

(** val weighted_entry :
    enclosed -> Big_int_Z.big_int list -> point -> int -> int -> Big_int_Z.big_int **)

let weighted_entry p d e i j =
  Big_int_Z.sub_big_int
    (Big_int_Z.mult_big_int (nth Big_int_Z.unit_big_int d i) (center p e i j))
    (Big_int_Z.mult_big_int (Big_int_Z.abs_big_int (nth Big_int_Z.unit_big_int d i))
      (radius p e i j))

(** val symmetric_part :
    enclosed -> Big_int_Z.big_int list -> point -> int -> int -> Big_int_Z.big_int **)

let symmetric_part p d e i j =
  Big_int_Z.add_big_int (weighted_entry p d e i j) (weighted_entry p d e j i)

(** val definite_end :
    enclosed -> Big_int_Z.big_int list -> bool -> point -> region -> factor -> bool **)

let definite_end p d strict e r f =
  (&&) (all (fun w -> Z.leb Big_int_Z.zero_big_int w) f.weights)
    ((&&) (eq_op nat_eqType (Obj.magic size f.factor_rows) (Obj.magic size (active p r)))
      (covered (symmetric_part p d e) (weighted_dot f.weights) strict
        (zip (active p r) f.factor_rows)))

(** val definite : enclosed -> Big_int_Z.big_int list -> region -> factor -> factor -> bool **)

let definite p d r low high =
  (&&) (definite_end p d true r.lower r low)
    (definite_end p d (Z.ltb Big_int_Z.zero_big_int (snd r.upper)) r.upper r high)

(** val box_definite :
    enclosed -> enclosed -> region -> Big_int_Z.big_int list -> (factor * factor) ->
    (factor * factor) -> bool **)

let box_definite p p' r d f f' =
  (&&) (definite p d r (fst f) (snd f)) (definite p' d r (fst f') (snd f'))

(** val signed_part : enclosed -> point -> int -> int -> Big_int_Z.big_int **)

let signed_part p e i j =
  if eq_op nat_eqType (Obj.magic i) (Obj.magic j)
  then Big_int_Z.sub_big_int
         (Big_int_Z.mult_big_int (Big_int_Z.mult_int_big_int 2 Big_int_Z.unit_big_int)
           (center p e i i))
         (sumZ (indices p) (fun k -> Big_int_Z.add_big_int (radius p e i k) (radius p e k i)))
  else Big_int_Z.add_big_int (center p e i j) (center p e j i)

(** val signed_end : enclosed -> bool -> point -> (Big_int_Z.big_int * factor) -> bool **)

let signed_end p strict e = function
| (c, f) ->
  (&&) (Z.ltb Big_int_Z.zero_big_int c)
    ((&&) (all (fun w -> Z.leb Big_int_Z.zero_big_int w) f.weights)
      ((&&) (eq_op nat_eqType (Obj.magic size f.factor_rows) (Obj.magic p.size_of))
        (covered (fun i j -> Big_int_Z.mult_big_int c (signed_part p e i j))
          (weighted_dot f.weights) strict (zip (indices p) f.factor_rows))))

type signed_ends = (Big_int_Z.big_int * factor) * (Big_int_Z.big_int * factor)

(** val signed_between : enclosed -> point -> point -> signed_ends -> bool **)

let signed_between p lo hi f =
  (&&) (signed_end p true lo (fst f))
    (signed_end p (Z.ltb Big_int_Z.zero_big_int (snd hi)) hi (snd f))

(** val box_signed : enclosed -> enclosed -> region -> signed_ends -> signed_ends -> bool **)

let box_signed p p' r f f' =
  (&&) (signed_between p r.lower r.upper f) (signed_between p' r.lower r.upper f')

type box = { inverse : matrix; unit_low : Big_int_Z.big_int; unit_high : Big_int_Z.big_int;
             width : Big_int_Z.big_int }

type uniqueness = { system_inverse : matrix; system_unit_low : Big_int_Z.big_int;
                    system_unit_high : Big_int_Z.big_int; system_rate : Big_int_Z.big_int }

(** val unit_entry : Big_int_Z.big_int -> int -> int -> Big_int_Z.big_int **)

let unit_entry u i j =
  if eq_op nat_eqType (Obj.magic j) (Obj.magic i) then u else Big_int_Z.zero_big_int

(** val product_center :
    enclosed -> int list -> matrix -> point -> int -> int -> Big_int_Z.big_int **)

let product_center p l y e i j =
  sumZ l (fun l0 -> Big_int_Z.mult_big_int (entry y i l0) (center p e l0 j))

(** val product_radius :
    enclosed -> int list -> matrix -> point -> int -> int -> Big_int_Z.big_int **)

let product_radius p l y e i j =
  sumZ l (fun l0 ->
    Big_int_Z.mult_big_int (Big_int_Z.abs_big_int (entry y i l0)) (radius p e l0 j))

(** val defect :
    enclosed -> int list -> matrix -> Big_int_Z.big_int -> point -> int -> Big_int_Z.big_int **)

let defect p k y u e i =
  sumZ k (fun j ->
    Big_int_Z.add_big_int
      (Big_int_Z.abs_big_int
        (Big_int_Z.sub_big_int (unit_entry u i j) (product_center p k y e i j)))
      (product_radius p k y e i j))

(** val residual :
    enclosed -> int list -> int list -> Big_int_Z.big_int list -> matrix -> point -> int ->
    Big_int_Z.big_int **)

let residual p j k v y e i =
  Big_int_Z.add_big_int
    (Big_int_Z.abs_big_int
      (sumZ j (fun j0 ->
        Big_int_Z.mult_big_int (product_center p k y e i j0) (nth Big_int_Z.zero_big_int v j0))))
    (sumZ j (fun j0 ->
      Big_int_Z.mult_big_int (product_radius p k y e i j0)
        (Big_int_Z.abs_big_int (nth Big_int_Z.zero_big_int v j0))))

(** val contracts :
    Big_int_Z.big_int -> Big_int_Z.big_int -> Big_int_Z.big_int -> Big_int_Z.big_int -> bool **)

let contracts u eps rho r =
  (&&) (Z.ltb rho u)
    (Z.leb (Big_int_Z.add_big_int (Big_int_Z.mult_big_int rho eps) r)
      (Big_int_Z.mult_big_int u eps))

(** val box_row :
    enclosed -> int list -> int list -> Big_int_Z.big_int list -> matrix -> Big_int_Z.big_int
    -> Big_int_Z.big_int -> point -> int -> bool **)

let box_row p j k v y u eps e i =
  contracts u eps (defect p k y u e i) (residual p j k v y e i)

(** val box_end :
    enclosed -> int list -> int list -> Big_int_Z.big_int list -> box -> Big_int_Z.big_int ->
    point -> bool **)

let box_end p j k v b u e =
  (&&) (Z.ltb Big_int_Z.zero_big_int u) (all (box_row p j k v b.inverse u b.width e) k)

(** val check_box :
    enclosed -> int list -> int list -> Big_int_Z.big_int list -> box -> point -> point -> bool **)

let check_box p j k v b lo hi =
  (&&) (Z.leb Big_int_Z.zero_big_int b.width)
    ((&&) (box_end p j k v b b.unit_low lo) (box_end p j k v b b.unit_high hi))

(** val sum_center :
    int list -> Big_int_Z.big_int list -> (int -> Big_int_Z.big_int) -> Big_int_Z.big_int **)

let sum_center j v f =
  sumZ j (fun j0 -> Big_int_Z.mult_big_int (f j0) (nth Big_int_Z.zero_big_int v j0))

(** val sum_radius :
    int list -> int -> Big_int_Z.big_int list -> (int -> Big_int_Z.big_int) -> (int ->
    Big_int_Z.big_int) -> Big_int_Z.big_int -> Big_int_Z.big_int **)

let sum_radius j k v f r eps =
  sumZ j (fun j0 ->
    Big_int_Z.add_big_int
      (Big_int_Z.mult_big_int (r j0) (Big_int_Z.abs_big_int (nth Big_int_Z.zero_big_int v j0)))
      (if eq_op nat_eqType (Obj.magic j0) (Obj.magic k)
       then Big_int_Z.zero_big_int
       else Big_int_Z.mult_big_int
              (Big_int_Z.add_big_int (Big_int_Z.abs_big_int (f j0)) (r j0)) eps))

(** val rate_center :
    enclosed -> int list -> Big_int_Z.big_int list -> matrix -> int -> Big_int_Z.big_int **)

let rate_center p j v y i =
  sumZ j (fun l -> Big_int_Z.mult_big_int (entry y i l) (sum_center j v (entry p.center_b l)))

(** val rate_radius :
    enclosed -> int list -> int -> Big_int_Z.big_int list -> matrix -> Big_int_Z.big_int -> int
    -> Big_int_Z.big_int **)

let rate_radius p j k v y eps i =
  sumZ j (fun l ->
    Big_int_Z.mult_big_int (Big_int_Z.abs_big_int (entry y i l))
      (sum_radius j k v (entry p.center_b l) (entry p.radius_b l) eps))

(** val system_center :
    enclosed -> int list -> int -> Big_int_Z.big_int list -> matrix -> Big_int_Z.big_int ->
    (Big_int_Z.big_int * Big_int_Z.big_int) -> int -> Equality.sort -> Big_int_Z.big_int **)

let system_center p j k v y w e i j0 =
  if eq_op nat_eqType j0 (Obj.magic k)
  then Big_int_Z.mult_big_int (snd e) (rate_center p j v y i)
  else Big_int_Z.mult_big_int w (product_center p j y e i (Obj.magic j0))

(** val system_radius :
    enclosed -> int list -> int -> Big_int_Z.big_int list -> matrix -> Big_int_Z.big_int ->
    Big_int_Z.big_int -> (Big_int_Z.big_int * Big_int_Z.big_int) -> int -> Equality.sort ->
    Big_int_Z.big_int **)

let system_radius p j k v y w eps e i j0 =
  if eq_op nat_eqType j0 (Obj.magic k)
  then Big_int_Z.mult_big_int (snd e) (rate_radius p j k v y eps i)
  else Big_int_Z.mult_big_int w (product_radius p j y e i (Obj.magic j0))

(** val unique_row :
    enclosed -> int list -> int -> Big_int_Z.big_int list -> matrix -> Big_int_Z.big_int ->
    Big_int_Z.big_int -> Big_int_Z.big_int -> (Big_int_Z.big_int * Big_int_Z.big_int) -> int ->
    bool **)

let unique_row p j k v y u w eps e i =
  Z.ltb
    (sumZ j (fun j0 ->
      Big_int_Z.add_big_int
        (Big_int_Z.abs_big_int
          (Big_int_Z.sub_big_int (unit_entry u i j0)
            (system_center p j k v y w e i (Obj.magic j0))))
        (system_radius p j k v y w eps e i (Obj.magic j0)))) u

(** val unique_end :
    enclosed -> int list -> int -> Big_int_Z.big_int list -> uniqueness -> Big_int_Z.big_int ->
    Big_int_Z.big_int -> (Big_int_Z.big_int * Big_int_Z.big_int) -> bool **)

let unique_end p j k v c u eps e =
  (&&) (Z.ltb Big_int_Z.zero_big_int u)
    (all (unique_row p j k v c.system_inverse u c.system_rate eps e) j)

(** val check_unique :
    enclosed -> int list -> int -> Big_int_Z.big_int list -> uniqueness -> Big_int_Z.big_int ->
    (Big_int_Z.big_int * Big_int_Z.big_int) -> (Big_int_Z.big_int * Big_int_Z.big_int) -> bool **)

let check_unique p j k v c eps lo hi =
  (&&) (Z.ltb Big_int_Z.zero_big_int c.system_rate)
    ((&&) (Z.leb Big_int_Z.zero_big_int eps)
      ((&&) (unique_end p j k v c c.system_unit_low eps lo)
        (unique_end p j k v c c.system_unit_high eps hi)))

type isolation = { pivot : int; vector : Big_int_Z.big_int list; from_point : point;
                   to_point : point; wide_box : box; narrow_box : box; unique : uniqueness;
                   left_vector : Big_int_Z.big_int list }

type outcome =
| Solution
| NegativeX of int
| NegativeY of int

type absence = { absent_pivot : int; absent_vector : Big_int_Z.big_int list; absent_box : 
                 box; absent_left : Big_int_Z.big_int list }

(** val moving : enclosed -> region -> int list **)

let moving p r =
  filter (fun i -> is_moving (state_of r i)) (indices p)

(** val others : enclosed -> region -> Equality.sort -> Equality.sort list **)

let others p r k =
  filter (fun i -> negb (eq_op nat_eqType i k)) (Obj.magic moving p r)

(** val decided : enclosed -> region -> bool **)

let decided p r =
  all (fun i -> (||) (is_resting (state_of r i)) (is_moving (state_of r i))) (indices p)

(** val point_le : point -> point -> bool **)

let point_le a b =
  Z.leb (Big_int_Z.mult_big_int (fst a) (snd b)) (Big_int_Z.mult_big_int (fst b) (snd a))

(** val left_center :
    enclosed -> region -> Big_int_Z.big_int list -> Big_int_Z.big_int list -> point ->
    Big_int_Z.big_int **)

let left_center p r v u e =
  sum_center (moving p r) v (product_center p (moving p r) (u :: []) e 0)

(** val left_radius :
    enclosed -> region -> int -> Big_int_Z.big_int list -> Big_int_Z.big_int list ->
    Big_int_Z.big_int -> point -> Big_int_Z.big_int **)

let left_radius p r k v u eps e =
  sum_radius (moving p r) k v (product_center p (moving p r) (u :: []) e 0)
    (product_radius p (moving p r) (u :: []) e 0) eps

(** val left_negative :
    enclosed -> region -> int -> Big_int_Z.big_int list -> Big_int_Z.big_int list ->
    Big_int_Z.big_int -> point -> bool **)

let left_negative p r k v u eps e =
  Z.ltb (Big_int_Z.add_big_int (left_center p r v u e) (left_radius p r k v u eps e))
    Big_int_Z.zero_big_int

(** val left_positive :
    enclosed -> region -> int -> Big_int_Z.big_int list -> Big_int_Z.big_int list ->
    Big_int_Z.big_int -> point -> bool **)

let left_positive p r k v u eps e =
  Z.ltb Big_int_Z.zero_big_int
    (Big_int_Z.sub_big_int (left_center p r v u e) (left_radius p r k v u eps e))

(** val row_center :
    enclosed -> region -> Big_int_Z.big_int list -> point -> int -> Big_int_Z.big_int **)

let row_center p r v e i =
  sum_center (moving p r) v (center p e i)

(** val row_radius :
    enclosed -> region -> int -> Big_int_Z.big_int list -> Big_int_Z.big_int -> point -> int ->
    Big_int_Z.big_int **)

let row_radius p r k v eps e i =
  sum_radius (moving p r) k v (center p e i) (radius p e i) eps

(** val row_positive :
    enclosed -> region -> int -> Big_int_Z.big_int list -> Big_int_Z.big_int -> point -> int ->
    bool **)

let row_positive p r k v eps e i =
  Z.ltb Big_int_Z.zero_big_int
    (Big_int_Z.sub_big_int (row_center p r v e i) (row_radius p r k v eps e i))

(** val row_negative :
    enclosed -> region -> int -> Big_int_Z.big_int list -> Big_int_Z.big_int -> point -> int ->
    bool **)

let row_negative p r k v eps e i =
  Z.ltb (Big_int_Z.add_big_int (row_center p r v e i) (row_radius p r k v eps e i))
    Big_int_Z.zero_big_int

(** val interval_inside : region -> isolation -> bool **)

let interval_inside r c =
  (&&) (ordered c.from_point c.to_point)
    ((&&) (Z.ltb Big_int_Z.zero_big_int (snd c.to_point))
      ((&&) (point_le r.lower c.from_point) (point_le c.to_point r.upper)))

(** val sign_change : enclosed -> region -> isolation -> bool **)

let sign_change p r c =
  (&&) (Z.ltb Big_int_Z.zero_big_int (nth Big_int_Z.zero_big_int c.left_vector c.pivot))
    ((||)
      ((&&) (left_negative p r c.pivot c.vector c.left_vector c.narrow_box.width c.from_point)
        (left_positive p r c.pivot c.vector c.left_vector c.narrow_box.width c.to_point))
      ((&&) (left_positive p r c.pivot c.vector c.left_vector c.narrow_box.width c.from_point)
        (left_negative p r c.pivot c.vector c.left_vector c.narrow_box.width c.to_point)))

(** val isolated : enclosed -> region -> isolation -> bool **)

let isolated p r c =
  (&&) (decided p r)
    ((&&) (in_mem (Obj.magic c.pivot) (mem (seq_predType nat_eqType) (Obj.magic moving p r)))
      ((&&) (Z.ltb Big_int_Z.zero_big_int (nth Big_int_Z.zero_big_int c.vector c.pivot))
        ((&&) (interval_inside r c)
          ((&&) (sign_change p r c)
            ((&&)
              (check_box p (moving p r) (Obj.magic others p r c.pivot) c.vector c.wide_box
                r.lower r.upper)
              ((&&)
                (check_box p (moving p r) (Obj.magic others p r c.pivot) c.vector c.narrow_box
                  c.from_point c.to_point)
                (check_unique p (moving p r) c.pivot c.vector c.unique c.wide_box.width r.lower
                  r.upper)))))))

(** val both_ends : isolation -> (point -> bool) -> bool **)

let both_ends c f =
  (&&) (f c.from_point) (f c.to_point)

(** val solution_signs : enclosed -> region -> isolation -> bool **)

let solution_signs p r c =
  (&&)
    (all (fun j ->
      Z.ltb c.narrow_box.width (nth Big_int_Z.zero_big_int c.vector (Obj.magic j)))
      (others p r (Obj.magic c.pivot)))
    (all (fun i ->
      (||) (is_moving (state_of r i))
        (both_ends c (fun e -> row_positive p r c.pivot c.vector c.narrow_box.width e i)))
      (indices p))

(** val outcome_signs : enclosed -> region -> isolation -> outcome -> bool **)

let outcome_signs p r c = function
| Solution -> solution_signs p r c
| NegativeX i ->
  (&&) (in_mem (Obj.magic i) (mem (seq_predType nat_eqType) (Obj.magic others p r c.pivot)))
    (Z.ltb (nth Big_int_Z.zero_big_int c.vector i) (Big_int_Z.minus_big_int c.narrow_box.width))
| NegativeY i ->
  (&&) (in_mem (Obj.magic i) (mem (seq_predType nat_eqType) (Obj.magic indices p)))
    ((&&) (negb (is_moving (state_of r i)))
      (both_ends c (fun e -> row_negative p r c.pivot c.vector c.narrow_box.width e i)))

(** val check_root : enclosed -> region -> isolation -> outcome -> bool **)

let check_root p r c o =
  (&&) (isolated p r c) (outcome_signs p r c o)

(** val check_absent : enclosed -> region -> absence -> bool **)

let check_absent p r c =
  let k = c.absent_pivot in
  let v = c.absent_vector in
  let eps = c.absent_box.width in
  (&&) (decided p r)
    ((&&) (in_mem (Obj.magic k) (mem (seq_predType nat_eqType) (Obj.magic moving p r)))
      ((&&) (Z.ltb Big_int_Z.zero_big_int (nth Big_int_Z.zero_big_int v k))
        ((&&)
          (check_box p (moving p r) (Obj.magic others p r k) v c.absent_box r.lower r.upper)
          ((||)
            ((&&) (left_positive p r k v c.absent_left eps r.lower)
              (left_positive p r k v c.absent_left eps r.upper))
            ((&&) (left_negative p r k v c.absent_left eps r.lower)
              (left_negative p r k v c.absent_left eps r.upper))))))

type pinning = { pin_pivot : int; pin_vector : Big_int_Z.big_int list; pin_box : box;
                 pin_unique : uniqueness; pin_reversed : bool }

type known = { known_from : point; known_to : point; known_support : int list;
               known_biactive : int list }

(** val swap : point -> point **)

let swap e =
  ((snd e), (fst e))

(** val reversed : enclosed -> enclosed **)

let reversed p =
  { size_of = p.size_of; center_a = p.center_b; center_b = p.center_a; radius_a = p.radius_b;
    radius_b = p.radius_a }

(** val pinned : enclosed -> region -> pinning -> bool **)

let pinned p r c =
  let k = c.pin_pivot in
  let v = c.pin_vector in
  let eps = c.pin_box.width in
  (&&) (decided p r)
    ((&&) (in_mem (Obj.magic k) (mem (seq_predType nat_eqType) (Obj.magic moving p r)))
      ((&&) (Z.ltb Big_int_Z.zero_big_int (nth Big_int_Z.zero_big_int v k))
        ((&&) (check_box p (moving p r) (Obj.magic others p r k) v c.pin_box r.lower r.upper)
          (if c.pin_reversed
           then (&&) (Z.ltb Big_int_Z.zero_big_int (fst r.lower))
                  (check_unique (reversed p) (moving p r) k v c.pin_unique eps (swap r.upper)
                    (swap r.lower))
           else check_unique p (moving p r) k v c.pin_unique eps r.lower r.upper))))

(** val known_inside : region -> known -> bool **)

let known_inside r q =
  (&&) (ordered q.known_from q.known_to)
    ((&&) (Z.ltb Big_int_Z.zero_big_int (snd q.known_to))
      ((&&) (point_le r.lower q.known_from) (point_le q.known_to r.upper)))

(** val check_claimed : enclosed -> region -> pinning -> known -> bool **)

let check_claimed p r c q =
  (&&) (pinned p r c)
    ((&&)
      (in_mem (Obj.magic c.pin_pivot)
        (mem (seq_predType nat_eqType) (Obj.magic q.known_support)))
      ((&&) (known_inside r q)
        ((&&)
          (all (fun i ->
            in_mem (Obj.magic i) (mem (seq_predType nat_eqType) (Obj.magic moving p r)))
            q.known_support)
          (all (fun i ->
            in_mem (Obj.magic i)
              (mem (seq_predType nat_eqType) (Obj.magic cat q.known_support q.known_biactive)))
            (moving p r)))))

(** val supports_region : enclosed -> region -> known -> bool **)

let supports_region p r q =
  all (fun i ->
    in_mem (Obj.magic i) (mem (seq_predType nat_eqType) (Obj.magic q.known_support)))
    (moving p r)

(** val check_infinite : enclosed -> region -> pinning -> bool **)

let check_infinite p r c =
  (&&) (pinned p r c)
    ((&&) c.pin_reversed (Big_int_Z.eq_big_int (snd r.upper) Big_int_Z.zero_big_int))

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

(** val extended : region -> interval -> region **)

let extended r h =
  { lower = (fst h); upper = (snd h); states = r.states }

(** val reaches : region -> interval -> bool **)

let reaches r h =
  (&&) (ordered (fst h) (snd h)) ((&&) (point_le (fst h) r.lower) (point_le r.upper (snd h)))

(** val window : point -> point -> region **)

let window lo hi =
  { lower = lo; upper = hi; states = [] }

(** val enclosed_order : int -> enclosed **)

let enclosed_order n =
  { size_of = n; center_a = []; center_b = []; radius_a = []; radius_b = [] }

(** val nothing_known : known **)

let nothing_known =
  { known_from = zero; known_to = zero; known_support = []; known_biactive = [] }

(** val known_at : known list -> int -> known **)

let known_at solutions n =
  nth nothing_known solutions n

(** val yielded : enclosed -> known list -> (region * 'a1 leaf) -> yield option **)

let yielded p solutions rl =
  match snd rl with
  | Root (h, c, o) ->
    (match o with
     | Solution ->
       Some { yield_region = (extended (fst rl) h); yield_from = c.from_point; yield_to =
         c.to_point }
     | _ -> None)
  | Claimed (h, _, n) ->
    let q = known_at solutions n in
    if supports_region p (fst rl) q
    then Some { yield_region = (extended (fst rl) h); yield_from = q.known_from; yield_to =
           q.known_to }
    else None
  | _ -> None

(** val yields : enclosed -> known list -> 'a1 leaf tree -> region -> yield list **)

let yields p solutions tr r =
  pmap (yielded p solutions) (leaves tr r)

(** val undecided : 'a1 leaf tree -> region -> region list **)

let undecided tr r =
  pmap (fun rl -> match snd rl with
                  | Undecided -> Some (fst rl)
                  | _ -> None) (leaves tr r)

(** val check_leaf :
    enclosed -> known list -> (region -> 'a1 -> bool) -> (region -> int -> Big_int_Z.big_int
    list -> bool) -> region -> 'a1 leaf -> bool **)

let check_leaf p solutions check_whole0 check_limit0 r = function
| Farkas w -> farkas p r w
| Definite (d, low, high) -> definite p d r low high
| Absent c -> check_absent p r c
| Root (h, c, o) -> (&&) (reaches r h) (check_root p (extended r h) c o)
| Claimed (h, c, n) ->
  (&&) (reaches r h)
    ((&&) (leq (Natural.succ n) (size solutions))
      (check_claimed p (extended r h) c (known_at solutions n)))
| Infinite (h, c, x) ->
  (&&) (reaches r h) ((&&) (check_infinite p (extended r h) c) (check_limit0 r c.pin_pivot x))
| Whole w -> check_whole0 r w
| Undecided -> true

(** val check_cover :
    enclosed -> known list -> (region -> 'a1 -> bool) -> (region -> int -> Big_int_Z.big_int
    list -> bool) -> 'a1 leaf tree -> point -> point -> bool **)

let check_cover p solutions check_whole0 check_limit0 tr lo hi =
  check_tree p.size_of (check_leaf p solutions check_whole0 check_limit0) tr (window lo hi)

(** val same_state : state -> state -> bool **)

let same_state a b =
  match a with
  | Open -> (match b with
             | Open -> true
             | _ -> false)
  | Resting -> (match b with
                | Resting -> true
                | _ -> false)
  | Moving -> (match b with
               | Moving -> true
               | _ -> false)

(** val opposite_state : state -> state -> bool **)

let opposite_state a b =
  match a with
  | Open -> false
  | Resting -> (match b with
                | Moving -> true
                | _ -> false)
  | Moving -> (match b with
               | Resting -> true
               | _ -> false)

(** val some_opposite : int -> region -> region -> bool **)

let some_opposite n r r' =
  has (fun i -> opposite_state (state_of r i) (state_of r' i)) (iota 0 n)

(** val all_same : int -> region -> region -> bool **)

let all_same n r r' =
  all (fun i -> same_state (state_of r i) (state_of r' i)) (iota 0 n)

(** val within : interval -> interval -> bool **)

let within inner0 outer =
  (&&) (ordered (fst inner0) (snd inner0))
    ((&&) (ordered (fst outer) (snd outer))
      ((&&) (point_le (fst outer) (fst inner0)) (point_le (snd inner0) (snd outer))))

(** val ends : region -> interval **)

let ends r =
  (r.lower, r.upper)

(** val value_of : yield -> interval **)

let value_of y =
  (y.yield_from, y.yield_to)

(** val point_lt : point -> point -> bool **)

let point_lt a b =
  (&&) (Z.leb Big_int_Z.zero_big_int (snd a))
    ((&&) (Z.leb Big_int_Z.zero_big_int (snd b))
      (Z.ltb (Big_int_Z.mult_big_int (fst a) (snd b)) (Big_int_Z.mult_big_int (fst b) (snd a))))

(** val same_solution : int -> yield -> yield -> bool **)

let same_solution n f g =
  (&&)
    ((||) (within (value_of f) (ends g.yield_region))
      (within (value_of g) (ends f.yield_region))) (all_same n f.yield_region g.yield_region)

(** val different_solutions : int -> yield -> yield -> bool **)

let different_solutions n f g =
  (||) (point_lt f.yield_to g.yield_from)
    ((||) (point_lt g.yield_to f.yield_from) (some_opposite n f.yield_region g.yield_region))

(** val distinct :
    int -> point -> point -> yield list -> yield list -> yield list -> yield list option **)

let rec distinct n lo hi seen kept = function
| [] -> Some kept
| y :: rest' ->
  if has (same_solution n y) seen
  then distinct n lo hi (y :: seen) kept rest'
  else if (&&) (within (value_of y) (lo, hi)) (all (different_solutions n y) kept)
       then distinct n lo hi (y :: seen) (y :: kept) rest'
       else None

(** val distinct_yields : int -> point -> point -> yield list -> yield list option **)

let distinct_yields n lo hi =
  distinct n lo hi [] []

type sparse_row = (int * Big_int_Z.big_int) list

(** val lookup : sparse_row -> int -> Big_int_Z.big_int **)

let lookup row j =
  foldr (fun entry0 sum0 ->
    if eq_op nat_eqType (fst (Obj.magic entry0)) (Obj.magic j)
    then Big_int_Z.add_big_int (snd entry0) sum0
    else sum0) Big_int_Z.zero_big_int row

(** val times_row : Big_int_Z.big_int -> sparse_row -> sparse_row **)

let times_row c row =
  map0 (fun e -> ((fst e), (Big_int_Z.mult_big_int c (snd e)))) row

type form_bound = { bound_times : Big_int_Z.big_int; bound_at : Big_int_Z.big_int;
                    gram_times : Big_int_Z.big_int; gram_rows : late_row list }

(** val columns_from : int -> int -> sparse_row list -> sparse_row list **)

let rec columns_from n i = function
| [] -> nseq n []
| row :: rows' ->
  foldr (fun e table0 -> set_nth [] table0 (fst e) ((i, (snd e)) :: (nth [] table0 (fst e))))
    (columns_from n (Natural.succ i) rows') row

(** val transposed : sparse_row list -> sparse_row list **)

let transposed rows =
  columns_from (size rows) 0 rows

(** val doubled_rows : sparse_row list -> (int * Big_int_Z.big_int) list list **)

let doubled_rows rows =
  map0 (fun r -> cat (fst r) (snd r)) (zip rows (transposed rows))

(** val spread : sparse_row -> Big_int_Z.big_int list **)

let spread row =
  foldr (fun e dense ->
    set_nth Big_int_Z.zero_big_int dense (fst e)
      (Big_int_Z.add_big_int (snd e) (nth Big_int_Z.zero_big_int dense (fst e)))) [] row

(** val shifted_row :
    Big_int_Z.big_int -> Big_int_Z.big_int -> int -> sparse_row -> sparse_row **)

let shifted_row c d i row =
  (i, (Big_int_Z.minus_big_int d)) :: (times_row c row)

(** val symmetric_rows_sparse : sparse_row list -> bool **)

let symmetric_rows_sparse rows =
  all_from (fun i row ->
    all (fun e -> Big_int_Z.eq_big_int (lookup row (fst e)) (lookup (nth [] rows (fst e)) i))
      row) 0 rows

(** val distance :
    Big_int_Z.big_int -> Big_int_Z.big_int list -> late_row -> late_row list ->
    Big_int_Z.big_int **)

let rec distance m row a = function
| [] -> Big_int_Z.zero_big_int
| b :: factor' ->
  Big_int_Z.add_big_int
    (Big_int_Z.abs_big_int
      (Big_int_Z.sub_big_int (head Big_int_Z.zero_big_int row)
        (Big_int_Z.mult_big_int m (late_dot a b)))) (distance m (behead row) a factor')

(** val row_bounded :
    Big_int_Z.big_int -> Big_int_Z.big_int -> Big_int_Z.big_int -> late_row list -> int ->
    (sparse_row * late_row) -> bool **)

let row_bounded c d m factor0 i r =
  let row = spread (shifted_row c d i (fst r)) in
  Z.leb (distance m row (snd r) factor0)
    (Big_int_Z.mult_big_int (Big_int_Z.mult_int_big_int 2 Big_int_Z.unit_big_int)
      (Big_int_Z.sub_big_int (nth Big_int_Z.zero_big_int row i)
        (Big_int_Z.mult_big_int m (late_dot (snd r) (snd r)))))

(** val bounded_rows : Equality.sort -> sparse_row list -> form_bound -> bool **)

let bounded_rows n rows b =
  (&&) (Z.ltb Big_int_Z.zero_big_int b.bound_times)
    ((&&) (Z.leb Big_int_Z.zero_big_int b.bound_at)
      ((&&) (Z.leb Big_int_Z.zero_big_int b.gram_times)
        ((&&) (eq_op nat_eqType (Obj.magic size rows) n)
          ((&&) (eq_op nat_eqType (Obj.magic size b.gram_rows) n)
            (all_from
              (row_bounded b.bound_times
                (Big_int_Z.mult_big_int (Big_int_Z.mult_int_big_int 2 Big_int_Z.unit_big_int)
                  b.bound_at)
                (Big_int_Z.mult_big_int (Big_int_Z.mult_int_big_int 2 Big_int_Z.unit_big_int)
                  b.gram_times) b.gram_rows) 0 (zip (doubled_rows rows) b.gram_rows))))))

type blocks = { free_count : int; slip_count : int; ff : sparse_row list; fs : matrix;
                sf_a : matrix; sf_b : matrix; ss_a : matrix; ss_b : matrix }

type elimination = { row_scale : Big_int_Z.big_int list; unit_of : Big_int_Z.big_int;
                     right_w : matrix; left_va : matrix; left_vb : matrix;
                     bound_c : Big_int_Z.big_int; bound_d : Big_int_Z.big_int;
                     factor_scale : Big_int_Z.big_int; stiffness_factor : late_row list }

(** val sparse_dot : sparse_row -> Big_int_Z.big_int list -> Big_int_Z.big_int **)

let sparse_dot row x =
  foldr (fun entry0 sum0 ->
    Big_int_Z.add_big_int
      (Big_int_Z.mult_big_int (snd entry0) (nth Big_int_Z.zero_big_int x (fst entry0))) sum0)
    Big_int_Z.zero_big_int row

(** val norm1 : Big_int_Z.big_int list -> Big_int_Z.big_int **)

let norm1 l =
  foldr (fun x sum0 -> Big_int_Z.add_big_int (Big_int_Z.abs_big_int x) sum0)
    Big_int_Z.zero_big_int l

(** val row_of : matrix -> int -> Big_int_Z.big_int list **)

let row_of m i =
  nth [] m i

(** val divide_up : Big_int_Z.big_int -> Big_int_Z.big_int -> Big_int_Z.big_int **)

let divide_up x d =
  Big_int_Z.minus_big_int (Z.div (Big_int_Z.minus_big_int x) d)

(** val eliminated_bound : elimination -> form_bound **)

let eliminated_bound w =
  { bound_times = w.bound_c; bound_at = w.bound_d; gram_times = w.factor_scale; gram_rows =
    w.stiffness_factor }

(** val stiffness_positive : blocks -> elimination -> bool **)

let stiffness_positive d w =
  (&&) (Z.ltb Big_int_Z.zero_big_int w.bound_d)
    ((&&)
      (all (fun row -> all (fun entry0 -> leq (Natural.succ (fst entry0)) d.free_count) row)
        d.ff) (bounded_rows (Obj.magic d.free_count) d.ff (eliminated_bound w)))

(** val residual_by :
    elimination -> sparse_row list -> matrix -> matrix -> int -> Big_int_Z.big_int list **)

let residual_by w rows g x j =
  let g0 = row_of g j in
  let x0 = row_of x j in
  map_from (fun i row ->
    Big_int_Z.sub_big_int (Big_int_Z.mult_big_int w.unit_of (nth Big_int_Z.zero_big_int g0 i))
      (sparse_dot row x0)) 0 rows

(** val residual_column :
    blocks -> elimination -> matrix -> matrix -> int -> Big_int_Z.big_int list **)

let residual_column d w =
  residual_by w d.ff

(** val table : blocks -> (int -> int -> Big_int_Z.big_int) -> matrix **)

let table d f =
  map0 (fun i -> map0 (fun j -> f i j) (iota 0 d.slip_count)) (iota 0 d.slip_count)

(** val condensed_center :
    blocks -> elimination -> matrix -> matrix -> matrix -> matrix -> matrix **)

let condensed_center d w ss sf v r =
  table d (fun i j ->
    Big_int_Z.mult_big_int (nth Big_int_Z.zero_big_int w.row_scale i)
      (Big_int_Z.sub_big_int
        (Big_int_Z.sub_big_int
          (Big_int_Z.mult_big_int (Big_int_Z.mult_big_int w.unit_of w.unit_of) (entry ss i j))
          (Big_int_Z.mult_big_int w.unit_of (dot (row_of sf i) (row_of w.right_w j))))
        (dot (row_of v i) (row_of r j))))

(** val condensed_radius :
    blocks -> elimination -> Big_int_Z.big_int list -> Big_int_Z.big_int list -> matrix **)

let condensed_radius d w norms_l norms_r =
  table d (fun i j ->
    divide_up
      (Big_int_Z.mult_big_int (nth Big_int_Z.zero_big_int w.row_scale i)
        (Big_int_Z.mult_big_int
          (Big_int_Z.mult_big_int (nth Big_int_Z.zero_big_int norms_l i)
            (nth Big_int_Z.zero_big_int norms_r j)) w.bound_c)) w.bound_d)

(** val condensed : blocks -> elimination -> enclosed **)

let condensed d w =
  let columns = fun rows g x -> map0 (fun j -> residual_by w rows g x j) (iota 0 d.slip_count)
  in
  let turned0 = transposed d.ff in
  let r = columns d.ff d.fs w.right_w in
  let norms_r = map0 norm1 r in
  let norms_a = map0 norm1 (columns turned0 d.sf_a w.left_va) in
  let norms_b = map0 norm1 (columns turned0 d.sf_b w.left_vb) in
  { size_of = d.slip_count; center_a = (condensed_center d w d.ss_a d.sf_a w.left_va r);
  center_b = (condensed_center d w d.ss_b d.sf_b w.left_vb r); radius_a =
  (condensed_radius d w norms_a norms_r); radius_b = (condensed_radius d w norms_b norms_r) }

(** val shapes : blocks -> elimination -> bool **)

let shapes d w =
  (&&) (Z.ltb Big_int_Z.zero_big_int w.unit_of)
    ((&&)
      (all (fun i -> Z.ltb Big_int_Z.zero_big_int (nth Big_int_Z.zero_big_int w.row_scale i))
        (iota 0 d.slip_count))
      (all (fun i ->
        all (fun m -> leq (size (row_of m i)) d.free_count)
          (d.fs :: (d.sf_a :: (d.sf_b :: (w.right_w :: (w.left_va :: (w.left_vb :: [])))))))
        (iota 0 d.slip_count)))

(** val check_elimination : blocks -> elimination -> bool **)

let check_elimination d w =
  (&&) (stiffness_positive d w) (shapes d w)

(** val mark : (int -> 'a1) -> int -> int list -> 'a1 option list -> 'a1 option list **)

let rec mark value0 k l table0 =
  match l with
  | [] -> table0
  | i :: l' -> set_nth None (mark value0 (Natural.succ k) l' table0) i (Some (value0 k))

(** val places : int list -> int option list **)

let places l =
  mark (fun x -> x) 0 l []

type pencil = { order : int; rows_a : sparse_row list; rows_b : sparse_row list; free : int list }

(** val slip : pencil -> int list **)

let slip q =
  filter (fun i ->
    negb (in_mem (Obj.magic i) (mem (seq_predType nat_eqType) (Obj.magic q.free))))
    (iota 0 q.order)

(** val row_a : pencil -> int -> (int * Big_int_Z.big_int) list **)

let row_a q i =
  nth [] q.rows_a i

(** val row_b : pencil -> int -> (int * Big_int_Z.big_int) list **)

let row_b q i =
  nth [] q.rows_b i

(** val wellformed : pencil -> bool **)

let wellformed q =
  (&&) (uniq nat_eqType (Obj.magic q.free)) (all (fun i -> leq (Natural.succ i) q.order) q.free)

(** val free_rows_constant : pencil -> bool **)

let free_rows_constant q =
  all (fun i -> all (fun e -> Big_int_Z.eq_big_int (snd e) Big_int_Z.zero_big_int) (row_b q i))
    q.free

(** val restrict : int option list -> sparse_row -> sparse_row **)

let restrict place0 row =
  pmap (fun e -> Option.map (fun k -> (k, (snd e))) (nth None place0 (fst e))) row

(** val blocks_by : pencil -> int option list -> int list -> blocks **)

let blocks_by q place0 columns =
  let lookups = fun row l -> map0 (fun j -> lookup row j) l in
  { free_count = (size q.free); slip_count = (size columns); ff =
  (map0 (fun i -> restrict place0 (row_a q i)) q.free); fs =
  (map0 (fun j -> map0 (fun i -> lookup (row_a q i) j) q.free) columns); sf_a =
  (map0 (fun i -> lookups (row_a q i) q.free) columns); sf_b =
  (map0 (fun i -> lookups (row_b q i) q.free) columns); ss_a =
  (map0 (fun i -> lookups (row_a q i) columns) columns); ss_b =
  (map0 (fun i -> lookups (row_b q i) columns) columns) }

(** val blocks_of : pencil -> blocks **)

let blocks_of q =
  blocks_by q (places q.free) (slip q)

type whole_factor =
| Dense of Big_int_Z.big_int list * matrix
| Late of Big_int_Z.big_int * late_row list

type whole_end = { end_scale : Big_int_Z.big_int; end_factor : whole_factor }

type whole = { whole_weights : Big_int_Z.big_int list; low_end : whole_end; high_end : whole_end }

type member = int * (sparse_row * sparse_row)

(** val weighted : Big_int_Z.big_int list -> int -> sparse_row -> sparse_row **)

let weighted weight i row =
  times_row (nth Big_int_Z.unit_big_int weight i) row

(** val may_move : pencil -> region -> int list **)

let may_move q r =
  let columns = slip q in
  cat q.free
    (map0 (fun j -> nth 0 columns j)
      (filter (fun j -> negb (is_resting (state_of r j))) (iota 0 (size columns))))

(** val members : pencil -> Big_int_Z.big_int list -> region -> member list **)

let members q weight r =
  map0 (fun i -> (i, ((weighted weight i (row_a q i)), (weighted weight i (row_b q i)))))
    (may_move q r)

(** val member_entry : point -> member -> member -> Big_int_Z.big_int **)

let member_entry e i j =
  Big_int_Z.add_big_int (Big_int_Z.mult_big_int (snd e) (lookup (fst (snd i)) (fst j)))
    (Big_int_Z.mult_big_int (fst e) (lookup (snd (snd i)) (fst j)))

(** val member_form : Big_int_Z.big_int -> point -> member -> member -> Big_int_Z.big_int **)

let member_form c e i j =
  Big_int_Z.mult_big_int c (Big_int_Z.add_big_int (member_entry e i j) (member_entry e j i))

(** val check_end :
    pencil -> Big_int_Z.big_int list -> bool -> point -> region -> whole_end -> bool **)

let check_end q weight strict e r w =
  (&&) (Z.ltb Big_int_Z.zero_big_int w.end_scale)
    (match w.end_factor with
     | Dense (weights0, rows) ->
       (&&) (all (fun u -> Z.leb Big_int_Z.zero_big_int u) weights0)
         ((&&) (eq_op nat_eqType (Obj.magic size rows) (Obj.magic size (members q weight r)))
           (covered (member_form w.end_scale e) (weighted_dot weights0) strict
             (zip (members q weight r) rows)))
     | Late (m, rows) ->
       (&&) (Z.leb Big_int_Z.zero_big_int m)
         ((&&) (eq_op nat_eqType (Obj.magic size rows) (Obj.magic size (members q weight r)))
           (covered (member_form w.end_scale e) (fun a b ->
             Big_int_Z.mult_big_int m (late_dot a b)) strict (zip (members q weight r) rows))))

(** val check_whole : pencil -> region -> whole -> bool **)

let check_whole q r w =
  (&&) (check_end q w.whole_weights true r.lower r w.low_end)
    (check_end q w.whole_weights (Z.ltb Big_int_Z.zero_big_int (snd r.upper)) r.upper r
      w.high_end)

type polynomial = Big_int_Z.big_int list

type reduction = { multiplier : Big_int_Z.big_int; quotient : polynomial; rest : polynomial }

type claim = { modulus : polynomial; claim_from : Big_int_Z.big_int;
               claim_to : Big_int_Z.big_int; claim_denominator : Big_int_Z.big_int;
               support : int list; biactive : int list; components : polynomial list;
               component_reductions : reduction list; reaction_reductions : reduction list }

(** val scale_poly : Big_int_Z.big_int -> polynomial -> polynomial **)

let scale_poly c p =
  map0 (fun a -> Big_int_Z.mult_big_int c a) p

(** val add_poly : polynomial -> polynomial -> polynomial **)

let rec add_poly p q =
  match p with
  | [] -> q
  | a :: p' ->
    (match q with
     | [] -> p
     | b :: q' -> (Big_int_Z.add_big_int a b) :: (add_poly p' q'))

(** val mul_poly : polynomial -> polynomial -> polynomial **)

let mul_poly p q =
  foldr (fun a product0 -> add_poly (scale_poly a q) (Big_int_Z.zero_big_int :: product0)) [] p

(** val zero_poly : polynomial -> bool **)

let zero_poly p =
  all (fun a -> Big_int_Z.eq_big_int a Big_int_Z.zero_big_int) p

(** val horner_interval :
    Big_int_Z.big_int -> Big_int_Z.big_int -> Big_int_Z.big_int -> polynomial ->
    (Big_int_Z.big_int * Big_int_Z.big_int) * Big_int_Z.big_int **)

let rec horner_interval a b d = function
| [] -> ((Big_int_Z.zero_big_int, Big_int_Z.zero_big_int), Big_int_Z.unit_big_int)
| c :: p' ->
  let (p0, power) = horner_interval a b d p' in
  let (lo, hi) = p0 in
  let constant0 = Big_int_Z.mult_big_int c (Big_int_Z.mult_big_int power d) in
  (((Big_int_Z.add_big_int
      (if Z.leb Big_int_Z.zero_big_int lo
       then Big_int_Z.mult_big_int a lo
       else Big_int_Z.mult_big_int b lo) constant0),
  (Big_int_Z.add_big_int
    (if Z.leb Big_int_Z.zero_big_int hi
     then Big_int_Z.mult_big_int b hi
     else Big_int_Z.mult_big_int a hi) constant0)), (Big_int_Z.mult_big_int power d))

(** val low_on :
    Big_int_Z.big_int -> Big_int_Z.big_int -> Big_int_Z.big_int -> polynomial ->
    Big_int_Z.big_int **)

let low_on a b d p =
  fst (fst (horner_interval a b d p))

(** val high_on :
    Big_int_Z.big_int -> Big_int_Z.big_int -> Big_int_Z.big_int -> polynomial ->
    Big_int_Z.big_int **)

let high_on a b d p =
  snd (fst (horner_interval a b d p))

(** val changes_sign :
    Big_int_Z.big_int -> Big_int_Z.big_int -> Big_int_Z.big_int -> polynomial -> bool **)

let changes_sign a b d p =
  (||)
    ((&&) (Z.leb (high_on a a d p) Big_int_Z.zero_big_int)
      (Z.leb Big_int_Z.zero_big_int (low_on b b d p)))
    ((&&) (Z.leb Big_int_Z.zero_big_int (low_on a a d p))
      (Z.leb (high_on b b d p) Big_int_Z.zero_big_int))

(** val same_poly : polynomial -> polynomial -> bool **)

let same_poly p q =
  zero_poly (add_poly p (scale_poly (Big_int_Z.minus_big_int Big_int_Z.unit_big_int) q))

(** val reduces_by : polynomial -> polynomial -> reduction -> bool **)

let reduces_by p g w =
  (&&) (Z.ltb Big_int_Z.zero_big_int w.multiplier)
    (same_poly (scale_poly w.multiplier g) (add_poly (mul_poly p w.quotient) w.rest))

(** val add_multiple :
    Big_int_Z.big_int -> Big_int_Z.big_int list -> Big_int_Z.big_int list -> Big_int_Z.big_int
    list **)

let rec add_multiple c x y =
  match x with
  | [] -> y
  | a :: x' ->
    (match y with
     | [] -> (Big_int_Z.mult_big_int c a) :: (add_multiple c x' [])
     | b :: y' ->
       (Big_int_Z.add_big_int (Big_int_Z.mult_big_int c a) b) :: (add_multiple c x' y'))

(** val combine_row : polynomial list -> sparse_row -> polynomial **)

let combine_row x row =
  foldr (fun e sum0 -> add_multiple (snd e) (nth [] x (fst e)) sum0) [] row

(** val row_poly : pencil -> polynomial list -> int -> polynomial **)

let row_poly q x i =
  add_poly (combine_row x (row_a q i)) (Big_int_Z.zero_big_int :: (combine_row x (row_b q i)))

(** val root_interval : claim -> bool **)

let root_interval k =
  (&&) (Z.leb Big_int_Z.zero_big_int k.claim_from)
    ((&&) (Z.leb k.claim_from k.claim_to)
      ((&&) (Z.ltb Big_int_Z.zero_big_int k.claim_denominator)
        (changes_sign k.claim_from k.claim_to k.claim_denominator k.modulus)))

(** val no_reduction : reduction **)

let no_reduction =
  { multiplier = Big_int_Z.unit_big_int; quotient = []; rest = [] }

(** val shows_zero : claim -> polynomial -> reduction -> bool **)

let shows_zero k g w =
  (&&) (reduces_by k.modulus g w) (zero_poly w.rest)

(** val shows_positive : claim -> polynomial -> reduction -> bool **)

let shows_positive k g w =
  (&&) (reduces_by k.modulus g w)
    (Z.ltb Big_int_Z.zero_big_int (low_on k.claim_from k.claim_to k.claim_denominator w.rest))

(** val shows_negative : claim -> polynomial -> reduction -> bool **)

let shows_negative k g w =
  (&&) (reduces_by k.modulus g w)
    (Z.ltb (high_on k.claim_from k.claim_to k.claim_denominator w.rest) Big_int_Z.zero_big_int)

(** val component : claim -> int -> Big_int_Z.big_int list **)

let component k i =
  nth [] k.components i

(** val reaction_poly : pencil -> claim -> int -> polynomial **)

let reaction_poly q k i =
  row_poly q k.components i

(** val component_witness : claim -> int -> reduction **)

let component_witness k i =
  nth no_reduction k.component_reductions i

(** val reaction_witness : claim -> int -> reduction **)

let reaction_witness k i =
  nth no_reduction k.reaction_reductions i

(** val x_zero : claim -> int -> bool **)

let x_zero k i =
  shows_zero k (component k i) (component_witness k i)

(** val x_positive : claim -> int -> bool **)

let x_positive k i =
  shows_positive k (component k i) (component_witness k i)

(** val x_negative : claim -> int -> bool **)

let x_negative k i =
  shows_negative k (component k i) (component_witness k i)

(** val y_zero : pencil -> claim -> int -> bool **)

let y_zero q k i =
  shows_zero k (reaction_poly q k i) (reaction_witness k i)

(** val y_positive : pencil -> claim -> int -> bool **)

let y_positive q k i =
  shows_positive k (reaction_poly q k i) (reaction_witness k i)

(** val columns_in_order : pencil -> bool **)

let columns_in_order q =
  (&&) (all (fun row -> all (fun e -> leq (Natural.succ (fst e)) q.order) row) q.rows_a)
    (all (fun row -> all (fun e -> leq (Natural.succ (fst e)) q.order) row) q.rows_b)

(** val check_claim : pencil -> claim -> bool **)

let check_claim q k =
  (&&) (wellformed q)
    ((&&) (columns_in_order q)
      ((&&) (root_interval k)
        ((&&) (all (fun i -> y_zero q k i) q.free)
          ((&&)
            (all (fun i ->
              in_mem (Obj.magic i) (mem (seq_predType nat_eqType) (Obj.magic slip q)))
              (cat k.support k.biactive))
            ((&&)
              (all (fun i ->
                if in_mem (Obj.magic i) (mem (seq_predType nat_eqType) (Obj.magic k.support))
                then (&&) (x_positive k i)
                       ((&&) (y_zero q k i)
                         (negb
                           (in_mem (Obj.magic i)
                             (mem (seq_predType nat_eqType) (Obj.magic k.biactive)))))
                else (&&) (x_zero k i)
                       (if in_mem (Obj.magic i)
                             (mem (seq_predType nat_eqType) (Obj.magic k.biactive))
                        then y_zero q k i
                        else y_positive q k i)) (slip q))
              ((||)
                (has (fun i ->
                  in_mem (Obj.magic i) (mem (seq_predType nat_eqType) (Obj.magic k.support)))
                  (slip q)) (has (fun i -> (||) (x_positive k i) (x_negative k i)) q.free)))))))

type enclosed_claim = { box_support : int list; box_from : point; box_to : point;
                        box_pivot : int; box_center : Big_int_Z.big_int list;
                        right_inverse : matrix; box_width : Big_int_Z.big_int;
                        rate_width : Big_int_Z.big_int; left_null : Big_int_Z.big_int list }

(** val scatter :
    Big_int_Z.big_int -> sparse_row -> Big_int_Z.big_int list -> Big_int_Z.big_int list **)

let scatter c row y =
  foldr (fun e y0 ->
    set_nth Big_int_Z.zero_big_int y0 (fst e)
      (Big_int_Z.add_big_int (Big_int_Z.mult_big_int c (snd e))
        (nth Big_int_Z.zero_big_int y0 (fst e)))) y row

(** val absolute_dot : sparse_row -> Big_int_Z.big_int list -> Big_int_Z.big_int **)

let absolute_dot row w =
  foldr (fun e sum0 ->
    Big_int_Z.add_big_int
      (Big_int_Z.mult_big_int (Big_int_Z.abs_big_int (snd e))
        (nth Big_int_Z.zero_big_int w (fst e))) sum0) Big_int_Z.zero_big_int row

(** val at_end : point -> Big_int_Z.big_int -> Big_int_Z.big_int -> Big_int_Z.big_int **)

let at_end e a b =
  Big_int_Z.add_big_int (Big_int_Z.mult_big_int (snd e) a) (Big_int_Z.mult_big_int (fst e) b)

(** val row_at_end :
    point -> Big_int_Z.big_int list -> Big_int_Z.big_int list -> Big_int_Z.big_int list **)

let row_at_end e a b =
  add_multiple (snd e) a (add_multiple (fst e) b [])

(** val box_active : pencil -> enclosed_claim -> Equality.sort -> bool **)

let box_active q c i =
  (||) (in_mem i (mem (seq_predType nat_eqType) (Obj.magic q.free)))
    (in_mem i (mem (seq_predType nat_eqType) (Obj.magic c.box_support)))

(** val active_list : pencil -> enclosed_claim -> Equality.sort list **)

let active_list q c =
  filter (fun i -> box_active q c i) (Obj.magic iota 0 q.order)

(** val pivot_removed : pencil -> enclosed_claim -> Equality.sort list **)

let pivot_removed q c =
  filter (fun i -> negb (eq_op nat_eqType i (Obj.magic c.box_pivot))) (active_list q c)

(** val inverse_vanishes_off : pencil -> enclosed_claim -> int list -> bool **)

let inverse_vanishes_off q c l =
  all (fun j ->
    (||) (in_mem (Obj.magic j) (mem (seq_predType nat_eqType) (Obj.magic l)))
      (Big_int_Z.eq_big_int (norm1 (nth [] c.right_inverse j)) Big_int_Z.zero_big_int))
    (iota 0 q.order)

(** val vanishes_elsewhere : pencil -> enclosed_claim -> bool **)

let vanishes_elsewhere q c =
  (&&)
    (all (fun j ->
      (||) (box_active q c (Obj.magic j))
        (Big_int_Z.eq_big_int (nth Big_int_Z.zero_big_int c.box_center j)
          Big_int_Z.zero_big_int)) (iota 0 q.order))
    (inverse_vanishes_off q c (Obj.magic pivot_removed q c))

(** val margin : Big_int_Z.big_int list -> int -> Big_int_Z.big_int **)

let margin g p =
  Big_int_Z.sub_big_int
    (Big_int_Z.mult_big_int (Big_int_Z.mult_int_big_int 2 Big_int_Z.unit_big_int)
      (nth Big_int_Z.zero_big_int g p)) (norm1 g)

(** val dominated :
    enclosed_claim -> int -> Big_int_Z.big_int list -> Big_int_Z.big_int -> Big_int_Z.big_int
    -> bool **)

let dominated c p g residual0 rate =
  (&&) (Z.ltb Big_int_Z.zero_big_int (margin g p))
    ((&&)
      (Z.leb (Big_int_Z.abs_big_int residual0)
        (Big_int_Z.mult_big_int (margin g p) c.box_width))
      (Z.leb rate (Big_int_Z.mult_big_int (margin g p) c.rate_width)))

(** val dominated_at :
    enclosed_claim -> point -> int -> Big_int_Z.big_int list -> Big_int_Z.big_int list ->
    Big_int_Z.big_int -> Big_int_Z.big_int -> Big_int_Z.big_int -> bool **)

let dominated_at c e p ga gb ra rb rate =
  dominated c p (row_at_end e ga gb) (at_end e ra rb) (Big_int_Z.mult_big_int (snd e) rate)

(** val dominated_ends :
    enclosed_claim -> int -> Big_int_Z.big_int list -> Big_int_Z.big_int list ->
    Big_int_Z.big_int -> Big_int_Z.big_int -> Big_int_Z.big_int -> bool **)

let dominated_ends c p ga gb ra rb rate =
  (&&) (dominated_at c c.box_from p ga gb ra rb rate)
    (dominated_at c c.box_to p ga gb ra rb rate)

(** val regular_row :
    pencil -> enclosed_claim -> Big_int_Z.big_int list -> int -> int -> bool **)

let regular_row q c eps p i =
  dominated_ends c p (combine_row c.right_inverse (row_a q i))
    (combine_row c.right_inverse (row_b q i)) (sparse_dot (row_a q i) c.box_center)
    (sparse_dot (row_b q i) c.box_center)
    (Big_int_Z.add_big_int (Big_int_Z.abs_big_int (sparse_dot (row_b q i) c.box_center))
      (absolute_dot (row_b q i) eps))

(** val norms : enclosed_claim -> Big_int_Z.big_int list **)

let norms c =
  map0 norm1 c.right_inverse

(** val widths : enclosed_claim -> Big_int_Z.big_int list **)

let widths c =
  map0 (fun row -> Big_int_Z.mult_big_int (norm1 row) c.box_width) c.right_inverse

(** val left_times :
    pencil -> enclosed_claim -> (int -> sparse_row) -> Big_int_Z.big_int list **)

let left_times q c rows =
  foldr (fun i sum0 ->
    scatter (nth Big_int_Z.zero_big_int c.left_null (Obj.magic i)) (Obj.magic rows i) sum0) []
    (active_list q c)

(** val left_value : pencil -> enclosed_claim -> (int -> sparse_row) -> Big_int_Z.big_int **)

let left_value q c rows =
  sumZ (Obj.magic active_list q c) (fun i ->
    Big_int_Z.mult_big_int (nth Big_int_Z.zero_big_int c.left_null i)
      (sparse_dot (rows i) c.box_center))

(** val weighted_norm :
    pencil -> enclosed_claim -> Big_int_Z.big_int list -> Big_int_Z.big_int list ->
    Big_int_Z.big_int **)

let weighted_norm q c l eps =
  sumZ (Obj.magic pivot_removed q c) (fun j ->
    Big_int_Z.mult_big_int (Big_int_Z.abs_big_int (nth Big_int_Z.zero_big_int l j))
      (nth Big_int_Z.zero_big_int eps j))

(** val above_radius :
    pencil -> enclosed_claim -> Big_int_Z.big_int list -> Big_int_Z.big_int list ->
    Big_int_Z.big_int list -> Big_int_Z.big_int -> Big_int_Z.big_int -> point -> bool **)

let above_radius q c eps la lb va vb e =
  Z.ltb (weighted_norm q c (row_at_end e la lb) eps) (at_end e va vb)

(** val below_radius :
    pencil -> enclosed_claim -> Big_int_Z.big_int list -> Big_int_Z.big_int list ->
    Big_int_Z.big_int list -> Big_int_Z.big_int -> Big_int_Z.big_int -> point -> bool **)

let below_radius q c eps la lb va vb e =
  Z.ltb (Big_int_Z.add_big_int (at_end e va vb) (weighted_norm q c (row_at_end e la lb) eps))
    Big_int_Z.zero_big_int

(** val opposite_signs :
    pencil -> enclosed_claim -> Big_int_Z.big_int list -> Big_int_Z.big_int list ->
    Big_int_Z.big_int list -> Big_int_Z.big_int -> Big_int_Z.big_int -> bool **)

let opposite_signs q c eps la lb va vb =
  (||)
    ((&&) (below_radius q c eps la lb va vb c.box_from)
      (above_radius q c eps la lb va vb c.box_to))
    ((&&) (above_radius q c eps la lb va vb c.box_from)
      (below_radius q c eps la lb va vb c.box_to))

(** val determinant_changes_sign :
    pencil -> enclosed_claim -> Big_int_Z.big_int list -> bool **)

let determinant_changes_sign q c eps =
  (&&) (Z.ltb Big_int_Z.zero_big_int (nth Big_int_Z.zero_big_int c.left_null c.box_pivot))
    (opposite_signs q c eps (left_times q c (row_a q)) (left_times q c (row_b q))
      (left_value q c (row_a q)) (left_value q c (row_b q)))

(** val one_root_at :
    pencil -> enclosed_claim -> Big_int_Z.big_int list -> Big_int_Z.big_int list ->
    Big_int_Z.big_int list -> Big_int_Z.big_int -> point -> bool **)

let one_root_at q c eps la lb vb e =
  Z.ltb
    (Big_int_Z.mult_big_int (weighted_norm q c (row_at_end e la lb) (norms c)) c.rate_width)
    (Big_int_Z.mult_big_int (snd e)
      (Big_int_Z.sub_big_int (Big_int_Z.abs_big_int vb) (weighted_norm q c lb eps)))

(** val one_root_between :
    pencil -> enclosed_claim -> Big_int_Z.big_int list -> Big_int_Z.big_int list ->
    Big_int_Z.big_int list -> Big_int_Z.big_int -> bool **)

let one_root_between q c eps la lb vb =
  (&&) (one_root_at q c eps la lb vb c.box_from) (one_root_at q c eps la lb vb c.box_to)

(** val one_root : pencil -> enclosed_claim -> Big_int_Z.big_int list -> bool **)

let one_root q c eps =
  one_root_between q c eps (left_times q c (row_a q)) (left_times q c (row_b q))
    (left_value q c (row_b q))

(** val reaction_positive :
    pencil -> enclosed_claim -> Big_int_Z.big_int list -> point -> int -> bool **)

let reaction_positive q c eps e i =
  Z.ltb (at_end e (absolute_dot (row_a q i) eps) (absolute_dot (row_b q i) eps))
    (at_end e (sparse_dot (row_a q i) c.box_center) (sparse_dot (row_b q i) c.box_center))

(** val box_signs : pencil -> enclosed_claim -> Big_int_Z.big_int list -> bool **)

let box_signs q c eps =
  (&&) (Z.ltb Big_int_Z.zero_big_int (nth Big_int_Z.zero_big_int c.box_center c.box_pivot))
    ((&&)
      (all (fun j ->
        Z.ltb (nth Big_int_Z.zero_big_int eps j) (nth Big_int_Z.zero_big_int c.box_center j))
        c.box_support)
      (all (fun i ->
        (||) (in_mem (Obj.magic i) (mem (seq_predType nat_eqType) (Obj.magic c.box_support)))
          ((&&) (reaction_positive q c eps c.box_from i) (reaction_positive q c eps c.box_to i)))
        (slip q)))

(** val check_enclosed_claim : pencil -> enclosed_claim -> bool **)

let check_enclosed_claim q c =
  (&&) (wellformed q)
    ((&&) (columns_in_order q)
      ((&&) (ordered c.box_from c.box_to)
        ((&&) (Z.ltb Big_int_Z.zero_big_int (snd c.box_to))
          ((&&)
            (in_mem (Obj.magic c.box_pivot)
              (mem (seq_predType nat_eqType) (Obj.magic c.box_support)))
            ((&&)
              (all (fun i ->
                in_mem (Obj.magic i) (mem (seq_predType nat_eqType) (Obj.magic slip q)))
                c.box_support)
              ((&&) (vanishes_elsewhere q c)
                ((&&) (Z.leb Big_int_Z.zero_big_int c.box_width)
                  ((&&) (Z.leb Big_int_Z.zero_big_int c.rate_width)
                    ((&&)
                      (all_from (Obj.magic regular_row q c (widths c)) 0 (pivot_removed q c))
                      ((&&) (determinant_changes_sign q c (widths c))
                        ((&&) (one_root q c (widths c)) (box_signs q c (widths c)))))))))))))

type solution_claim =
| ExactClaim of claim
| BoxClaim of enclosed_claim

(** val positions : pencil -> int list -> int list **)

let positions q l =
  map0 (fun i -> index nat_eqType (Obj.magic i) (Obj.magic slip q)) l

(** val claimed_support : solution_claim -> int list **)

let claimed_support = function
| ExactClaim e -> e.support
| BoxClaim b -> b.box_support

(** val claimed_biactive : solution_claim -> int list **)

let claimed_biactive = function
| ExactClaim e -> e.biactive
| BoxClaim _ -> []

(** val claimed_from : solution_claim -> point **)

let claimed_from = function
| ExactClaim e -> (e.claim_from, e.claim_denominator)
| BoxClaim b -> b.box_from

(** val claimed_to : solution_claim -> point **)

let claimed_to = function
| ExactClaim e -> (e.claim_to, e.claim_denominator)
| BoxClaim b -> b.box_to

(** val known_of : pencil -> solution_claim -> known **)

let known_of q k =
  { known_from = (claimed_from k); known_to = (claimed_to k); known_support =
    (positions q (claimed_support k)); known_biactive = (positions q (claimed_biactive k)) }

(** val check_solution_claim : pencil -> solution_claim -> bool **)

let check_solution_claim q = function
| ExactClaim e -> check_claim q e
| BoxClaim b -> check_enclosed_claim q b

(** val known_solutions : pencil -> solution_claim list -> known list **)

let known_solutions q claims =
  map0 (fun k -> known_of q k) claims

(** val check_null :
    pencil -> (int -> sparse_row) -> region -> int -> Big_int_Z.big_int list -> bool **)

let check_null q free_row r k x =
  let at_slip = fun j -> nth Big_int_Z.zero_big_int x (nth 0 (slip q) j) in
  (&&) (columns_in_order q)
    ((&&) (negb (Big_int_Z.eq_big_int (at_slip k) Big_int_Z.zero_big_int))
      ((&&)
        (all (fun i -> Big_int_Z.eq_big_int (sparse_dot (free_row i) x) Big_int_Z.zero_big_int)
          q.free)
        (all (fun j ->
          if is_moving (state_of r j)
          then Big_int_Z.eq_big_int (sparse_dot (row_b q (nth 0 (slip q) j)) x)
                 Big_int_Z.zero_big_int
          else Big_int_Z.eq_big_int (at_slip j) Big_int_Z.zero_big_int)
          (iota 0 (size (slip q))))))

(** val check_limit : pencil -> region -> int -> Big_int_Z.big_int list -> bool **)

let check_limit q r k x =
  (&&) (leq (Natural.succ k) (size (slip q))) (check_null q (row_a q) r k x)

(** val check_blocks :
    pencil -> solution_claim list -> elimination -> whole leaf tree -> point -> point -> blocks
    -> bool **)

let check_blocks q claims w tr lo hi d =
  (&&) (wellformed q)
    ((&&) (free_rows_constant q)
      ((&&) (check_elimination d w)
        ((&&) (all (check_solution_claim q) claims)
          (check_cover (condensed d w) (known_solutions q claims) (check_whole q)
            (check_limit q) tr lo hi))))

(** val check_complete :
    pencil -> solution_claim list -> elimination -> whole leaf tree -> point -> point -> bool **)

let check_complete q claims w tr lo hi =
  check_blocks q claims w tr lo hi (blocks_of q)

(** val found :
    pencil -> solution_claim list -> whole leaf tree -> point -> point -> yield list **)

let found q claims tr lo hi =
  yields (enclosed_order (size (slip q))) (known_solutions q claims) tr (window lo hi)

(** val left_open : whole leaf tree -> point -> point -> region list **)

let left_open tr lo hi =
  undecided tr (window lo hi)

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

(** val table_row : sparse_row list -> sparse_row -> sparse_row **)

let table_row table0 row =
  flatten
    (map0 (fun e ->
      map0 (fun c -> ((fst c), (Big_int_Z.mult_big_int (snd c) (snd e))))
        (nth [] table0 (fst e))) row)

(** val pencil_of_forms : sparse_row list -> int -> linear_form list -> int list -> pencil **)

let pencil_of_forms table0 order0 forms free0 =
  { order = order0; rows_a = (map0 (fun f -> table_row table0 (fst f)) forms); rows_b =
    (map0 (fun f -> table_row table0 (snd f)) forms); free = free0 }

(** val free_number : system -> int **)

let free_number s =
  size s.free_dofs

(** val first_dofs : system -> int list **)

let first_dofs s =
  map0 (fun p -> p.first_dof) s.particles

(** val second_dofs : system -> int list **)

let second_dofs s =
  map0 (fun p -> p.second_dof) s.particles

(** val moving_dofs : system -> int list **)

let moving_dofs s =
  cat s.free_dofs (cat (first_dofs s) (second_dofs s))

(** val particle : system -> int -> slip_particle **)

let particle s j =
  nth { first_dof = 0; second_dof = 0; tangent = (Big_int_Z.zero_big_int,
    Big_int_Z.zero_big_int); normal = (Big_int_Z.zero_big_int, Big_int_Z.zero_big_int);
    sign_of = Big_int_Z.zero_big_int; geometric_stiffness = Big_int_Z.zero_big_int }
    s.particles j

(** val k_row : system -> int -> (int * Big_int_Z.big_int) list **)

let k_row s d =
  nth [] s.stiffness d

(** val m_row : system -> int -> (int * Big_int_Z.big_int) list **)

let m_row s d =
  nth [] s.mass d

(** val column : system -> Equality.sort -> (int * Big_int_Z.big_int) option **)

let column s d =
  if in_mem d (mem (seq_predType nat_eqType) (Obj.magic s.free_dofs))
  then Some ((index nat_eqType d (Obj.magic s.free_dofs)), s.unit_length)
  else if in_mem d (mem (seq_predType nat_eqType) (Obj.magic first_dofs s))
       then let j = index nat_eqType d (Obj.magic first_dofs s) in
            Some ((addn (free_number s) j),
            (Big_int_Z.minus_big_int
              (Big_int_Z.mult_big_int (particle s j).sign_of (fst (particle s j).tangent))))
       else if in_mem d (mem (seq_predType nat_eqType) (Obj.magic second_dofs s))
            then let j = index nat_eqType d (Obj.magic second_dofs s) in
                 Some ((addn (free_number s) j),
                 (Big_int_Z.minus_big_int
                   (Big_int_Z.mult_big_int (particle s j).sign_of (snd (particle s j).tangent))))
            else None

(** val column_table : system -> (int * Big_int_Z.big_int) option list **)

let column_table s =
  let along = fun part j -> ((addn (free_number s) j),
    (Big_int_Z.minus_big_int
      (Big_int_Z.mult_big_int (particle s j).sign_of (part (particle s j).tangent))))
  in
  mark (fun k -> (k, s.unit_length)) 0 s.free_dofs
    (mark (along fst) 0 (first_dofs s) (mark (along snd) 0 (second_dofs s) []))

(** val column_rows : system -> sparse_row list **)

let column_rows s =
  map0 (fun c -> match c with
                 | Some entry0 -> entry0 :: []
                 | None -> []) (column_table s)

(** val multiple : Big_int_Z.big_int -> sparse_row -> sparse_row **)

let multiple c row =
  if Big_int_Z.eq_big_int c Big_int_Z.zero_big_int then [] else times_row c row

(** val direction : Big_int_Z.big_int -> Big_int_Z.big_int -> slip_particle -> planar **)

let direction a b p =
  ((Big_int_Z.add_big_int (Big_int_Z.mult_big_int a (fst p.tangent))
     (Big_int_Z.mult_big_int b (fst p.normal))),
    (Big_int_Z.add_big_int (Big_int_Z.mult_big_int a (snd p.tangent))
      (Big_int_Z.mult_big_int b (snd p.normal))))

(** val at_both : (int -> sparse_row) -> slip_particle -> planar -> sparse_row **)

let at_both rows p e =
  cat (multiple (fst e) (rows p.first_dof)) (multiple (snd e) (rows p.second_dof))

(** val force_form : system -> unknown -> int -> linear_form **)

let force_form s u d =
  ((k_row s d), (match u with
                 | Mu -> []
                 | Lambda2 (_, _) -> m_row s d))

(** val pressing_form : system -> unknown -> planar -> slip_particle -> linear_form **)

let pressing_form s u e p =
  ((at_both (k_row s) p e), (match u with
                             | Mu -> []
                             | Lambda2 (_, _) -> at_both (m_row s) p e))

(** val inner : planar -> planar -> Big_int_Z.big_int **)

let inner a b =
  Big_int_Z.add_big_int (Big_int_Z.mult_big_int (fst a) (fst b))
    (Big_int_Z.mult_big_int (snd a) (snd b))

(** val unit_square : system -> Big_int_Z.big_int **)

let unit_square s =
  Big_int_Z.mult_big_int s.unit_length s.unit_length

(** val turning_numerator :
    system -> Big_int_Z.big_int -> Big_int_Z.big_int -> slip_particle -> Big_int_Z.big_int **)

let turning_numerator s m q p =
  Big_int_Z.mult_big_int
    (Big_int_Z.add_big_int
      (Big_int_Z.mult_big_int (Big_int_Z.mult_big_int q q) (unit_square s))
      (Big_int_Z.mult_big_int (Big_int_Z.mult_big_int m m) (inner p.normal p.normal)))
    p.geometric_stiffness

(** val turning : system -> unknown -> slip_particle -> Big_int_Z.big_int **)

let turning s u p =
  match u with
  | Mu -> Big_int_Z.zero_big_int
  | Lambda2 (m, q) ->
    Z.div (turning_numerator s m q p) (Big_int_Z.mult_big_int q (unit_square s))

(** val turns_exactly : system -> unknown -> slip_particle -> bool **)

let turns_exactly s u p =
  match u with
  | Mu -> Big_int_Z.eq_big_int p.geometric_stiffness Big_int_Z.zero_big_int
  | Lambda2 (m, q) ->
    Big_int_Z.eq_big_int
      (Big_int_Z.mult_big_int (Big_int_Z.mult_big_int q (unit_square s)) (turning s u p))
      (turning_numerator s m q p)

(** val sliding_row : Big_int_Z.big_int -> slip_particle -> sparse_row **)

let sliding_row a p =
  multiple a ((p.first_dof, (fst p.tangent)) :: ((p.second_dof, (snd p.tangent)) :: []))

(** val cone_form : system -> unknown -> slip_particle -> linear_form **)

let cone_form s u p =
  match u with
  | Mu ->
    ((at_both (k_row s) p (direction p.sign_of Big_int_Z.zero_big_int p)),
      (at_both (k_row s) p (direction Big_int_Z.zero_big_int Big_int_Z.unit_big_int p)))
  | Lambda2 (m, q) ->
    ((cat (at_both (k_row s) p (direction (Big_int_Z.mult_big_int q p.sign_of) m p))
       (sliding_row (Big_int_Z.mult_big_int (turning s u p) p.sign_of) p)),
      (at_both (m_row s) p (direction (Big_int_Z.mult_big_int q p.sign_of) m p)))

(** val negative : linear_form -> linear_form **)

let negative f =
  ((multiple (Big_int_Z.minus_big_int Big_int_Z.unit_big_int) (fst f)),
    (multiple (Big_int_Z.minus_big_int Big_int_Z.unit_big_int) (snd f)))

(** val system_forms : system -> unknown -> linear_form list **)

let system_forms s u =
  cat (map0 (fun d -> force_form s u d) s.free_dofs)
    (map0 (fun p -> negative (cone_form s u p)) s.particles)

(** val pencil_of : system -> unknown -> pencil **)

let pencil_of s u =
  pencil_of_forms (column_rows s) (addn (free_number s) (size s.particles)) (system_forms s u)
    (iota 0 (free_number s))

(** val columns_in_range : system -> sparse_row list -> bool **)

let columns_in_range s rows =
  all (fun row -> all (fun e -> leq (Natural.succ (fst e)) s.dofs) row) rows

(** val particle_wellformed : system -> unknown -> slip_particle -> bool **)

let particle_wellformed s u p =
  (&&)
    (Big_int_Z.eq_big_int (Big_int_Z.mult_big_int p.sign_of p.sign_of) Big_int_Z.unit_big_int)
    ((&&) (Big_int_Z.eq_big_int (inner p.tangent p.tangent) (unit_square s))
      ((&&) (Z.ltb Big_int_Z.zero_big_int (inner p.normal p.normal))
        ((&&) (Big_int_Z.eq_big_int (inner p.tangent p.normal) Big_int_Z.zero_big_int)
          (turns_exactly s u p))))

(** val system_wellformed : system -> unknown -> bool **)

let system_wellformed s u =
  (&&) (uniq nat_eqType (Obj.magic moving_dofs s))
    ((&&) (all (fun d -> leq (Natural.succ d) s.dofs) (moving_dofs s))
      ((&&) (all (particle_wellformed s u) s.particles)
        ((&&) ((&&) (columns_in_range s s.stiffness) (columns_in_range s s.mass))
          ((&&) (Z.ltb Big_int_Z.zero_big_int s.unit_length)
            (match u with
             | Mu -> true
             | Lambda2 (_, q) -> Z.ltb Big_int_Z.zero_big_int q)))))

(** val flat : system -> bool **)

let flat s =
  all (fun p -> Big_int_Z.eq_big_int p.geometric_stiffness Big_int_Z.zero_big_int) s.particles

type lifted = { motion_claim : claim; forces : polynomial list;
                force_reductions : reduction list; balance_reductions : reduction list;
                normal_reductions : reduction list; rate_reductions : reduction list;
                cone_reductions : reduction list }

(** val witness : reduction list -> int -> reduction **)

let witness list0 i =
  nth no_reduction list0 i

(** val subtract : polynomial -> polynomial -> polynomial **)

let subtract p q =
  add_poly p (scale_poly (Big_int_Z.minus_big_int Big_int_Z.unit_big_int) q)

(** val v_poly : lifted -> int -> Big_int_Z.big_int list **)

let v_poly l d =
  component l.motion_claim d

(** val w_poly : lifted -> int -> Big_int_Z.big_int list **)

let w_poly l d =
  nth [] l.forces d

(** val balance_poly : system -> unknown -> lifted -> int -> polynomial **)

let balance_poly s u l d =
  let stiff = combine_row l.motion_claim.components (k_row s d) in
  let inertia =
    match u with
    | Mu -> []
    | Lambda2 (_, _) ->
      Big_int_Z.zero_big_int :: (combine_row l.motion_claim.components (m_row s d))
  in
  subtract (add_poly stiff inertia) (w_poly l d)

(** val along_poly : planar -> slip_particle -> (int -> polynomial) -> polynomial **)

let along_poly e p f =
  add_poly (scale_poly (fst e) (f p.first_dof)) (scale_poly (snd e) (f p.second_dof))

(** val normal_poly : lifted -> slip_particle -> polynomial **)

let normal_poly l p =
  along_poly p.normal p (v_poly l)

(** val rate_poly : lifted -> slip_particle -> polynomial **)

let rate_poly l p =
  scale_poly p.sign_of (along_poly p.tangent p (v_poly l))

(** val cone_poly : system -> unknown -> lifted -> slip_particle -> polynomial **)

let cone_poly s u l p =
  let turned0 = scale_poly (turning s u p) (rate_poly l p) in
  (match u with
   | Mu ->
     add_poly (scale_poly p.sign_of (along_poly p.tangent p (w_poly l)))
       (Big_int_Z.zero_big_int :: (along_poly p.normal p (w_poly l)))
   | Lambda2 (m, q) ->
     add_poly
       (add_poly
         (scale_poly (Big_int_Z.mult_big_int q p.sign_of) (along_poly p.tangent p (w_poly l)))
         (scale_poly m (along_poly p.normal p (w_poly l)))) turned0)

(** val balanced : system -> unknown -> lifted -> int -> bool **)

let balanced s u l d =
  shows_zero l.motion_claim (balance_poly s u l d) (witness l.balance_reductions d)

(** val without_force : lifted -> int -> bool **)

let without_force l d =
  shows_zero l.motion_claim (w_poly l d) (witness l.force_reductions d)

(** val at_rest : lifted -> int -> bool **)

let at_rest l d =
  shows_zero l.motion_claim (v_poly l d) (component_witness l.motion_claim d)

(** val dof_moves : lifted -> int -> bool **)

let dof_moves l d =
  (||) (shows_positive l.motion_claim (v_poly l d) (component_witness l.motion_claim d))
    (shows_negative l.motion_claim (v_poly l d) (component_witness l.motion_claim d))

(** val in_support : system -> lifted -> int -> bool **)

let in_support s l j =
  in_mem (Obj.magic addn (free_number s) j)
    (mem (seq_predType nat_eqType) (Obj.magic l.motion_claim.support))

(** val is_biactive : system -> lifted -> int -> bool **)

let is_biactive s l j =
  in_mem (Obj.magic addn (free_number s) j)
    (mem (seq_predType nat_eqType) (Obj.magic l.motion_claim.biactive))

(** val particle_states : system -> unknown -> lifted -> int -> bool **)

let particle_states s u l j =
  let p = particle s j in
  let rate = witness l.rate_reductions j in
  let reaction = witness l.cone_reductions j in
  (&&) (shows_zero l.motion_claim (normal_poly l p) (witness l.normal_reductions j))
    ((&&)
      (if in_support s l j
       then shows_negative l.motion_claim (rate_poly l p) rate
       else shows_zero l.motion_claim (rate_poly l p) rate)
      (if (||) (in_support s l j) (is_biactive s l j)
       then shows_zero l.motion_claim (cone_poly s u l p) reaction
       else shows_negative l.motion_claim (cone_poly s u l p) reaction))

type zero_system = { without_zero : system; zero_particles : slip_particle list }

type zero_claim = { lifted_part : lifted; opening_reductions : reduction list;
                    pressure_reductions : reduction list; sliding_reductions : reduction list;
                    right_reductions : reduction list; left_reductions : reduction list }

(** val zero_particle : zero_system -> int -> slip_particle **)

let zero_particle z0 j =
  nth { first_dof = 0; second_dof = 0; tangent = (Big_int_Z.zero_big_int,
    Big_int_Z.zero_big_int); normal = (Big_int_Z.zero_big_int, Big_int_Z.zero_big_int);
    sign_of = Big_int_Z.zero_big_int; geometric_stiffness = Big_int_Z.zero_big_int }
    z0.zero_particles j

(** val zero_dofs : zero_system -> int list **)

let zero_dofs z0 =
  cat (map0 (fun p -> p.first_dof) z0.zero_particles)
    (map0 (fun p -> p.second_dof) z0.zero_particles)

(** val moving_with_zero : zero_system -> int list **)

let moving_with_zero z0 =
  cat (moving_dofs z0.without_zero) (zero_dofs z0)

(** val gap : zero_system -> int -> int **)

let gap z0 j =
  addn (addn (free_number z0.without_zero) (size z0.without_zero.particles))
    (muln (Natural.succ (Natural.succ (Natural.succ 0))) j)

(** val right : zero_system -> int -> int **)

let right z0 j =
  Natural.succ (gap z0 j)

(** val left : zero_system -> int -> int **)

let left z0 j =
  Natural.succ (Natural.succ (gap z0 j))

(** val frame_wellformed : zero_system -> slip_particle -> bool **)

let frame_wellformed z0 p =
  (&&)
    (Big_int_Z.eq_big_int (inner p.tangent p.tangent)
      (Big_int_Z.mult_big_int z0.without_zero.unit_length z0.without_zero.unit_length))
    ((&&) (Z.ltb Big_int_Z.zero_big_int (inner p.normal p.normal))
      (Big_int_Z.eq_big_int (inner p.tangent p.normal) Big_int_Z.zero_big_int))

(** val zero_wellformed : zero_system -> unknown -> bool **)

let zero_wellformed z0 u =
  (&&) (system_wellformed z0.without_zero u)
    ((&&) (uniq nat_eqType (Obj.magic moving_with_zero z0))
      ((&&)
        (all (fun p ->
          (&&) (leq (Natural.succ p.first_dof) z0.without_zero.dofs)
            (leq (Natural.succ p.second_dof) z0.without_zero.dofs)) z0.zero_particles)
        (all (frame_wellformed z0) z0.zero_particles)))

(** val with_sign : Big_int_Z.big_int -> slip_particle -> slip_particle **)

let with_sign sign0 p =
  { first_dof = p.first_dof; second_dof = p.second_dof; tangent = p.tangent; normal = p.normal;
    sign_of = sign0; geometric_stiffness = Big_int_Z.zero_big_int }

(** val sliding_poly : zero_claim -> slip_particle -> polynomial **)

let sliding_poly c p =
  along_poly p.tangent p (v_poly c.lifted_part)

(** val pressure_poly : zero_claim -> slip_particle -> polynomial **)

let pressure_poly c p =
  along_poly p.normal p (w_poly c.lifted_part)

(** val right_poly : zero_system -> unknown -> zero_claim -> slip_particle -> polynomial **)

let right_poly z0 u c p =
  cone_poly z0.without_zero u c.lifted_part
    (with_sign (Big_int_Z.minus_big_int Big_int_Z.unit_big_int) p)

(** val left_poly : zero_system -> unknown -> zero_claim -> slip_particle -> polynomial **)

let left_poly z0 u c p =
  cone_poly z0.without_zero u c.lifted_part (with_sign Big_int_Z.unit_big_int p)

(** val row_state : zero_claim -> Equality.sort -> polynomial -> reduction -> bool **)

let row_state c i g w =
  if (||)
       (in_mem i (mem (seq_predType nat_eqType) (Obj.magic c.lifted_part.motion_claim.support)))
       (in_mem i
         (mem (seq_predType nat_eqType) (Obj.magic c.lifted_part.motion_claim.biactive)))
  then shows_zero c.lifted_part.motion_claim g w
  else shows_negative c.lifted_part.motion_claim g w

(** val zero_states : zero_system -> unknown -> zero_claim -> int -> bool **)

let zero_states z0 u c j =
  let p = zero_particle z0 j in
  let opening = witness c.opening_reductions j in
  let sliding = witness c.sliding_reductions j in
  (&&)
    (negb
      ((&&)
        (in_mem (Obj.magic right z0 j)
          (mem (seq_predType nat_eqType) (Obj.magic c.lifted_part.motion_claim.support)))
        (in_mem (Obj.magic left z0 j)
          (mem (seq_predType nat_eqType) (Obj.magic c.lifted_part.motion_claim.support)))))
    ((&&)
      (if in_mem (Obj.magic gap z0 j)
            (mem (seq_predType nat_eqType) (Obj.magic c.lifted_part.motion_claim.support))
       then shows_negative c.lifted_part.motion_claim (normal_poly c.lifted_part p) opening
       else shows_zero c.lifted_part.motion_claim (normal_poly c.lifted_part p) opening)
      ((&&)
        (row_state c (Obj.magic gap z0 j) (pressure_poly c p) (witness c.pressure_reductions j))
        ((&&)
          (if in_mem (Obj.magic right z0 j)
                (mem (seq_predType nat_eqType) (Obj.magic c.lifted_part.motion_claim.support))
           then shows_positive c.lifted_part.motion_claim (sliding_poly c p) sliding
           else if in_mem (Obj.magic left z0 j)
                     (mem (seq_predType nat_eqType)
                       (Obj.magic c.lifted_part.motion_claim.support))
                then shows_negative c.lifted_part.motion_claim (sliding_poly c p) sliding
                else shows_zero c.lifted_part.motion_claim (sliding_poly c p) sliding)
          ((&&)
            (row_state c (Obj.magic right z0 j) (right_poly z0 u c p)
              (witness c.right_reductions j))
            (row_state c (Obj.magic left z0 j) (left_poly z0 u c p)
              (witness c.left_reductions j))))))

(** val zero_variables : zero_system -> int list -> bool **)

let zero_variables z0 =
  all (fun i ->
    (&&) (leq (free_number z0.without_zero) i)
      (leq (Natural.succ i)
        (addn (addn (free_number z0.without_zero) (size z0.without_zero.particles))
          (muln (Natural.succ (Natural.succ (Natural.succ 0))) (size z0.zero_particles)))))

(** val check_zero : zero_system -> unknown -> zero_claim -> bool **)

let check_zero z0 u c =
  (&&) (zero_wellformed z0 u)
    ((&&) (root_interval c.lifted_part.motion_claim)
      ((&&)
        (zero_variables z0
          (cat c.lifted_part.motion_claim.support c.lifted_part.motion_claim.biactive))
        ((&&) (all (balanced z0.without_zero u c.lifted_part) (iota 0 z0.without_zero.dofs))
          ((&&) (all (without_force c.lifted_part) z0.without_zero.free_dofs)
            ((&&)
              (all (fun d ->
                (||)
                  (in_mem (Obj.magic d)
                    (mem (seq_predType nat_eqType) (Obj.magic moving_with_zero z0)))
                  (at_rest c.lifted_part d)) (iota 0 z0.without_zero.dofs))
              ((&&)
                (all (particle_states z0.without_zero u c.lifted_part)
                  (iota 0 (size z0.without_zero.particles)))
                ((&&) (all (zero_states z0 u c) (iota 0 (size z0.zero_particles)))
                  ((||)
                    (has (in_support z0.without_zero c.lifted_part)
                      (iota 0 (size z0.without_zero.particles)))
                    (has (dof_moves c.lifted_part) (iota 0 z0.without_zero.dofs))))))))))

type bound = (Big_int_Z.big_int * Big_int_Z.big_int) option

type mcp_row = { row_m : sparse_row; row_q : Big_int_Z.big_int; lower_bound : bound;
                 upper_bound : bound }

type mcp = mcp_row list

type mcp_point = { numerators : Big_int_Z.big_int list; denominator : Big_int_Z.big_int }

(** val no_row : mcp_row **)

let no_row =
  { row_m = []; row_q = Big_int_Z.zero_big_int; lower_bound = None; upper_bound = None }

(** val mcp_row_at : mcp -> int -> mcp_row **)

let mcp_row_at p i =
  nth no_row p i

(** val bound_wellformed : bound -> bool **)

let bound_wellformed = function
| Some p0 -> let (_, den) = p0 in Z.ltb Big_int_Z.zero_big_int den
| None -> true

(** val row_wellformed : mcp -> mcp_row -> bool **)

let row_wellformed p r =
  (&&) (all (fun e -> leq (Natural.succ (fst e)) (size p)) r.row_m)
    ((&&) (bound_wellformed r.lower_bound) (bound_wellformed r.upper_bound))

(** val coordinate : mcp_point -> int -> Big_int_Z.big_int **)

let coordinate z0 i =
  nth Big_int_Z.zero_big_int z0.numerators i

(** val function_value : mcp -> mcp_point -> int -> Big_int_Z.big_int **)

let function_value p z0 i =
  Big_int_Z.add_big_int (sparse_dot (mcp_row_at p i).row_m z0.numerators)
    (Big_int_Z.mult_big_int z0.denominator (mcp_row_at p i).row_q)

(** val bounds_kept : mcp -> mcp_point -> int -> bool **)

let bounds_kept p z0 i =
  (&&)
    (match (mcp_row_at p i).lower_bound with
     | Some p0 ->
       let (num, den) = p0 in
       Z.leb (Big_int_Z.mult_big_int num z0.denominator)
         (Big_int_Z.mult_big_int (coordinate z0 i) den)
     | None -> true)
    (match (mcp_row_at p i).upper_bound with
     | Some p0 ->
       let (num, den) = p0 in
       Z.leb (Big_int_Z.mult_big_int (coordinate z0 i) den)
         (Big_int_Z.mult_big_int num z0.denominator)
     | None -> true)

(** val at_bound : mcp_point -> bound -> int -> bool **)

let at_bound z0 b i =
  match b with
  | Some p0 ->
    let (num, den) = p0 in
    Big_int_Z.eq_big_int (Big_int_Z.mult_big_int (coordinate z0 i) den)
      (Big_int_Z.mult_big_int num z0.denominator)
  | None -> false

(** val row_holds : mcp -> mcp_point -> int -> bool **)

let row_holds p z0 i =
  (&&) (bounds_kept p z0 i)
    ((&&)
      ((||) (at_bound z0 (mcp_row_at p i).upper_bound i)
        (Z.leb Big_int_Z.zero_big_int (function_value p z0 i)))
      ((||) (at_bound z0 (mcp_row_at p i).lower_bound i)
        (Z.leb (function_value p z0 i) Big_int_Z.zero_big_int)))

(** val check_point : mcp -> mcp_point -> bool **)

let check_point p z0 =
  (&&) (Z.ltb Big_int_Z.zero_big_int z0.denominator)
    ((&&) (eq_op nat_eqType (Obj.magic size z0.numerators) (Obj.magic size p))
      (all (row_holds p z0) (iota 0 (size p))))

(** val mcp_wellformed : mcp -> bool **)

let mcp_wellformed p =
  all (row_wellformed p) p

(** val check_mcp : mcp -> mcp_point list -> bool **)

let check_mcp p points =
  (&&) (mcp_wellformed p) ((&&) (negb (nilp points)) (all (check_point p) points))

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

(** val slope_interval :
    Big_int_Z.big_int -> Big_int_Z.big_int -> Big_int_Z.big_int -> polynomial ->
    ((Big_int_Z.big_int * Big_int_Z.big_int) * Big_int_Z.big_int) * Big_int_Z.big_int **)

let rec slope_interval a b d = function
| [] ->
  (((Big_int_Z.zero_big_int, Big_int_Z.zero_big_int), Big_int_Z.unit_big_int),
    Big_int_Z.zero_big_int)
| c :: p' ->
  let (p0, slope) = slope_interval a b d p' in
  let (p1, power) = p0 in
  let (lo, hi) = p1 in
  let constant0 = Big_int_Z.mult_big_int c (Big_int_Z.mult_big_int power d) in
  ((((Big_int_Z.add_big_int
       (if Z.leb Big_int_Z.zero_big_int lo
        then Big_int_Z.mult_big_int a lo
        else Big_int_Z.mult_big_int b lo) constant0),
  (Big_int_Z.add_big_int
    (if Z.leb Big_int_Z.zero_big_int hi
     then Big_int_Z.mult_big_int b hi
     else Big_int_Z.mult_big_int a hi) constant0)), (Big_int_Z.mult_big_int power d)),
  (Big_int_Z.add_big_int (Big_int_Z.mult_big_int d lo)
    (if Z.leb Big_int_Z.zero_big_int slope
     then Big_int_Z.mult_big_int a slope
     else Big_int_Z.mult_big_int b slope)))

(** val slope_low :
    Big_int_Z.big_int -> Big_int_Z.big_int -> Big_int_Z.big_int -> polynomial ->
    Big_int_Z.big_int **)

let slope_low a b d p =
  snd (slope_interval a b d p)

(** val check_value : value -> bool **)

let check_value v =
  let { value_poly = p; value_from = a; value_to = b; value_den = d } = v in
  (&&) (Z.leb Big_int_Z.zero_big_int a)
    ((&&) (Z.leb a b)
      ((&&) (Z.ltb Big_int_Z.zero_big_int d)
        ((&&) (Z.leb (high_on a a d p) Big_int_Z.zero_big_int)
          ((&&) (Z.leb Big_int_Z.zero_big_int (low_on b b d p))
            ((||) (Big_int_Z.eq_big_int a b) (Z.ltb Big_int_Z.zero_big_int (slope_low a b d p)))))))

(** val low_of : value -> polynomial -> Big_int_Z.big_int **)

let low_of v g =
  low_on v.value_from v.value_to v.value_den g

(** val power_poly : polynomial -> int -> polynomial **)

let power_poly p i =
  iter i (mul_poly p) (Big_int_Z.unit_big_int :: [])

(** val factors : polynomial -> polynomial -> near -> bool **)

let factors p g w =
  (&&) (Z.ltb Big_int_Z.zero_big_int w.near_multiplier)
    (same_poly (scale_poly w.near_multiplier g)
      (mul_poly (power_poly p w.near_power) w.near_cofactor))

(** val rational : value -> bool **)

let rational v =
  Big_int_Z.eq_big_int v.value_from v.value_to

(** val positive_after : value -> polynomial -> near -> bool **)

let positive_after v g w =
  (||) (rational v)
    ((&&) (factors v.value_poly g w) (Z.ltb Big_int_Z.zero_big_int (low_of v w.near_cofactor)))

(** val positive_before : value -> polynomial -> near -> bool **)

let positive_before v g w =
  (||) (rational v)
    ((&&)
      (factors (scale_poly (Big_int_Z.minus_big_int Big_int_Z.unit_big_int) v.value_poly) g w)
      (Z.ltb Big_int_Z.zero_big_int (low_of v w.near_cofactor)))

(** val moebius : point -> point -> polynomial -> polynomial * polynomial **)

let rec moebius l u = function
| [] -> ([], (Big_int_Z.unit_big_int :: []))
| c :: g' ->
  let (numerator, power) = moebius l u g' in
  let power' = mul_poly ((snd l) :: ((snd u) :: [])) power in
  ((add_poly (scale_poly c power') (mul_poly ((fst l) :: ((fst u) :: [])) numerator)), power')

(** val positive_on : bool -> point -> point -> polynomial -> bool **)

let positive_on open0 l u g =
  let (numerator, _) = moebius l u g in
  (&&) (all (fun c -> Z.leb Big_int_Z.zero_big_int c) numerator)
    (if open0
     then has (fun c -> Z.ltb Big_int_Z.zero_big_int c) numerator
     else Z.ltb Big_int_Z.zero_big_int (head Big_int_Z.zero_big_int numerator))

(** val positive_between : bool -> point -> point list -> point -> polynomial -> bool **)

let rec positive_between open0 l cuts u g =
  match cuts with
  | [] -> positive_on open0 l u g
  | c :: cuts' ->
    (&&) (Z.ltb Big_int_Z.zero_big_int (snd c))
      ((&&) (positive_on open0 l c g) (positive_between false c cuts' u g))

(** val end_of : value -> point **)

let end_of v =
  (v.value_to, v.value_den)

(** val start_of : value -> point **)

let start_of v =
  (v.value_from, v.value_den)

(** val positive_in : place -> polynomial -> sign_evidence -> bool **)

let positive_in pl g e =
  match pl with
  | PointAt v ->
    (match e with
     | Remainder w ->
       (&&) (reduces_by v.value_poly g w) (Z.ltb Big_int_Z.zero_big_int (low_of v w.rest))
     | _ -> false)
  | Between (v, v') ->
    (match e with
     | Parts (n, cuts, n') ->
       (&&) (positive_after v g n)
         ((&&) (positive_before v' g n')
           (positive_between true (end_of v) cuts (start_of v') g))
     | _ -> false)
  | Above v ->
    (match e with
     | Parts (n, cuts, _) ->
       (&&) (positive_after v g n) (positive_between true (end_of v) cuts infinity g)
     | _ -> false)

(** val zero_in : place -> polynomial -> sign_evidence -> bool **)

let zero_in pl g e =
  match pl with
  | PointAt v ->
    (match e with
     | Identity -> zero_poly g
     | Remainder w -> (&&) (reduces_by v.value_poly g w) (zero_poly w.rest)
     | Parts (_, _, _) -> false)
  | _ -> (match e with
          | Identity -> zero_poly g
          | _ -> false)

(** val place_checked : place -> bool **)

let place_checked = function
| PointAt v -> check_value v
| Between (v, v') -> (&&) (check_value v) (check_value v')
| Above v -> check_value v

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

(** val shows : place -> polynomial -> signed -> bool **)

let shows pl g c =
  match fst c with
  | IsZero -> zero_in pl g (snd c)
  | IsPositive -> positive_in pl g (snd c)
  | IsNegative ->
    positive_in pl (scale_poly (Big_int_Z.minus_big_int Big_int_Z.unit_big_int) g) (snd c)

(** val is_zero : signed -> bool **)

let is_zero c =
  match fst c with
  | IsZero -> true
  | _ -> false

(** val is_positive : signed -> bool **)

let is_positive c =
  match fst c with
  | IsPositive -> true
  | _ -> false

(** val is_negative : signed -> bool **)

let is_negative c =
  match fst c with
  | IsNegative -> true
  | _ -> false

(** val sign_at : signed list -> int -> claimed_sign * sign_evidence **)

let sign_at signs i =
  nth (IsZero, Identity) signs i

(** val is_free : pencil -> int -> bool **)

let is_free q i =
  in_mem (Obj.magic i) (mem (seq_predType nat_eqType) (Obj.magic q.free))

(** val moves : pencil -> region -> int -> bool **)

let moves q r i =
  (&&) (negb (is_free q i))
    (is_moving (state_of r (index nat_eqType (Obj.magic i) (Obj.magic slip q))))

(** val rests : pencil -> region -> int -> bool **)

let rests q r i =
  (&&) (negb (is_free q i))
    (is_resting (state_of r (index nat_eqType (Obj.magic i) (Obj.magic slip q))))

(** val is_active : pencil -> region -> int -> bool **)

let is_active q r i =
  (||) (is_free q i) (moves q r i)

(** val decided_region : pencil -> region -> bool **)

let decided_region q r =
  all (fun i -> (||) (is_active q r i) (rests q r i)) (iota 0 q.order)

(** val component_of : poly_vector -> int -> Big_int_Z.big_int list **)

let component_of x i =
  nth [] x i

(** val times_entry : pencil -> int -> int -> polynomial -> polynomial **)

let times_entry q i j p =
  mul_poly ((lookup (row_a q i) j) :: ((lookup (row_b q i) j) :: [])) p

(** val column_poly : pencil -> poly_vector -> int -> polynomial **)

let column_poly q w j =
  foldr (fun i sum0 ->
    match component_of w i with
    | [] -> sum0
    | _ :: _ -> add_poly (times_entry q i j (component_of w i)) sum0) [] (iota 0 q.order)

(** val check_refutation : pencil -> region -> place -> refutation -> bool **)

let check_refutation q r pl f =
  (&&)
    (all (fun i ->
      (||) (negb (rests q r i))
        ((&&) (negb (is_negative (sign_at f.weight_signs i)))
          (shows pl (component_of f.row_weights i) (sign_at f.weight_signs i))))
      (iota 0 q.order))
    ((&&)
      (all (fun j ->
        (||) (negb (is_active q r j))
          ((&&) (negb (is_positive (sign_at f.column_signs j)))
            ((&&) ((||) (negb (is_free q j)) (is_zero (sign_at f.column_signs j)))
              (shows pl (column_poly q f.row_weights j) (sign_at f.column_signs j)))))
        (iota 0 q.order))
      (has (fun j -> (&&) (moves q r j) (is_negative (sign_at f.column_signs j)))
        (iota 0 q.order)))

(** val check_branch : pencil -> region -> place -> branch -> bool **)

let check_branch q r pl b =
  (&&) (columns_in_order q)
    ((&&) (has (moves q r) (iota 0 q.order))
      ((&&)
        (all (fun i ->
          (||) (negb (moves q r i))
            ((&&) (is_positive (sign_at b.x_signs i))
              (shows pl (component_of b.branch_x i) (sign_at b.x_signs i)))) (iota 0 q.order))
        ((&&)
          (all (fun i ->
            (||) (negb (rests q r i))
              ((&&) (is_zero (sign_at b.x_signs i))
                (shows pl (component_of b.branch_x i) (sign_at b.x_signs i)))) (iota 0 q.order))
          (all (fun i ->
            (&&) (negb (is_negative (sign_at b.y_signs i)))
              ((&&) ((||) (negb (is_active q r i)) (is_zero (sign_at b.y_signs i)))
                (shows pl (row_poly q b.branch_x i) (sign_at b.y_signs i)))) (iota 0 q.order)))))

(** val check_bound : pencil -> region -> place -> branch -> int -> bound0 -> bool **)

let check_bound q r pl b k o =
  let f = o.bound_signs in
  (&&) (is_active q r o.bounded)
    ((&&) (leq (Natural.succ o.bounded) q.order)
      ((&&)
        (all (fun i ->
          (||) (negb (rests q r i))
            ((&&) (negb (is_negative (sign_at f.weight_signs i)))
              ((&&) ((||) (is_zero (sign_at f.weight_signs i)) (is_zero (sign_at b.y_signs i)))
                (shows pl (component_of f.row_weights i) (sign_at f.weight_signs i)))))
          (iota 0 q.order))
        (all (fun j ->
          (||) (negb (is_active q r j))
            ((||) (eq_op nat_eqType (Obj.magic j) (Obj.magic k))
              ((&&)
                ((||) (eq_op nat_eqType (Obj.magic j) (Obj.magic o.bounded))
                  (is_zero (sign_at f.column_signs j)))
                (shows pl (column_poly q f.row_weights j) (sign_at f.column_signs j)))))
          (iota 0 q.order))))

(** val own_sign : bound0 -> claimed_sign * sign_evidence **)

let own_sign o =
  sign_at o.bound_signs.column_signs o.bounded

(** val check_alone : pencil -> region -> place -> branch -> bool **)

let check_alone q r pl b =
  match b.alone_by with
  | Some p ->
    let (k, bounds) = p in
    (&&) (moves q r k)
      ((&&) (leq (Natural.succ k) q.order)
        ((&&) (all (check_bound q r pl b k) bounds)
          (all (fun j ->
            (||) (negb (is_active q r j))
              ((||) (eq_op nat_eqType (Obj.magic j) (Obj.magic k))
                ((&&)
                  (has (fun o ->
                    (&&) (eq_op nat_eqType (Obj.magic o.bounded) (Obj.magic j))
                      (is_positive (own_sign o))) bounds)
                  (has (fun o ->
                    (&&) (eq_op nat_eqType (Obj.magic o.bounded) (Obj.magic j))
                      (is_negative (own_sign o))) bounds)))) (iota 0 q.order))))
  | None -> true

(** val inside : region -> place -> bool **)

let inside r pl =
  let above0 = fun v ->
    Z.leb (Big_int_Z.mult_big_int (fst r.lower) v.value_den)
      (Big_int_Z.mult_big_int v.value_from (snd r.lower))
  in
  let below1 = fun v ->
    Z.leb (Big_int_Z.mult_big_int v.value_to (snd r.upper))
      (Big_int_Z.mult_big_int (fst r.upper) v.value_den)
  in
  (match pl with
   | PointAt v -> (&&) (above0 v) (below1 v)
   | Between (v, v') ->
     (&&) (above0 v)
       ((&&) (below1 v')
         (Z.ltb (Big_int_Z.mult_big_int v.value_to v'.value_den)
           (Big_int_Z.mult_big_int v'.value_from v.value_den)))
   | Above v -> (&&) (above0 v) (Big_int_Z.eq_big_int (snd r.upper) Big_int_Z.zero_big_int))

(** val check_reason : pencil -> region -> place -> reason -> bool **)

let check_reason q r pl e =
  (&&) (place_checked pl)
    (match e with
     | Refuted f -> check_refutation q r pl f
     | Solved b -> (&&) (inside r pl) ((&&) (check_branch q r pl b) (check_alone q r pl b)))

(** val chain_places : value -> chain -> (place * reason) list **)

let rec chain_places v = function
| Stop -> []
| Last e -> ((Above v), e) :: []
| Next (e, v', e', c') -> ((Between (v, v')), e) :: (((PointAt v'), e') :: (chain_places v' c'))

(** val leaf_places : support_leaf -> (place * reason) list **)

let leaf_places l =
  ((PointAt l.first_value), l.first_reason) :: (chain_places l.first_value l.further)

(** val reaches_end : region -> value -> chain -> bool **)

let rec reaches_end r v = function
| Stop ->
  (&&) (Z.ltb Big_int_Z.zero_big_int (snd r.upper))
    (Z.leb (Big_int_Z.mult_big_int (fst r.upper) v.value_den)
      (Big_int_Z.mult_big_int v.value_from (snd r.upper)))
| Last _ -> true
| Next (_, v', _, c') -> reaches_end r v' c'

(** val check_support : pencil -> region -> support_leaf -> bool **)

let check_support q r l =
  (&&) (wellformed q)
    ((&&) (decided_region q r)
      ((&&)
        (Z.leb (Big_int_Z.mult_big_int l.first_value.value_to (snd r.lower))
          (Big_int_Z.mult_big_int (fst r.lower) l.first_value.value_den))
        ((&&) (reaches_end r l.first_value l.further)
          (all (fun pe -> check_reason q r (fst pe) (snd pe)) (leaf_places l)))))

(** val holding_of : (place * reason) -> holding option **)

let holding_of pe =
  match snd pe with
  | Refuted _ -> None
  | Solved b -> Some { held_place = (fst pe); held_alone = (isSome b.alone_by) }

(** val holdings : support_leaf -> holding list **)

let holdings l =
  pmap holding_of (leaf_places l)

type family = region * holding

(** val same_value : value -> value -> bool **)

let same_value v v' =
  (&&) (Big_int_Z.eq_big_int v.value_from v'.value_from)
    ((&&) (Big_int_Z.eq_big_int v.value_to v'.value_to)
      ((&&) (Big_int_Z.eq_big_int v.value_den v'.value_den)
        (same_poly v.value_poly v'.value_poly)))

(** val ends_before : value -> value -> bool **)

let ends_before v v' =
  Z.ltb (Big_int_Z.mult_big_int v.value_to v'.value_den)
    (Big_int_Z.mult_big_int v'.value_from v.value_den)

(** val away : value -> place -> bool **)

let away v = function
| PointAt v' -> (||) (same_value v v') ((||) (ends_before v v') (ends_before v' v))
| Between (v', v'') -> (||) (ends_before v v') (ends_before v'' v)
| Above v' -> ends_before v v'

(** val isolated_value : support_leaf -> holding -> value option **)

let isolated_value l h =
  let { held_place = held_place0; held_alone = held_alone0 } = h in
  (match held_place0 with
   | PointAt v ->
     if held_alone0
     then if all (fun h' -> away v h'.held_place) (holdings l) then Some v else None
     else None
   | _ -> None)

(** val yield_of : region -> value -> yield **)

let yield_of r v =
  { yield_region = { lower = (start_of v); upper = (end_of v); states = r.states };
    yield_from = (start_of v); yield_to = (end_of v) }

(** val isolated_in : region -> support_leaf -> yield list **)

let isolated_in r l =
  pmap (fun h -> Option.map (yield_of r) (isolated_value l h)) (holdings l)

(** val families_in : region -> support_leaf -> family list **)

let families_in r l =
  map0 (fun h -> (r, h)) (filter (fun h -> negb (isSome (isolated_value l h))) (holdings l))

(** val pairs :
    region list -> support_leaf option list -> (region * support_leaf option) list **)

let pairs =
  zip

(** val check_supports : pencil -> region list -> support_leaf option list -> bool **)

let check_supports q rs ls =
  (&&) (eq_op nat_eqType (Obj.magic size rs) (Obj.magic size ls))
    (all (fun rl ->
      match snd rl with
      | Some l -> (&&) (ordered (fst rl).lower (fst rl).upper) (check_support q (fst rl) l)
      | None -> true) (pairs rs ls))

(** val isolated_of : region list -> support_leaf option list -> yield list **)

let isolated_of rs ls =
  flatten
    (map0 (fun rl -> match snd rl with
                     | Some l -> isolated_in (fst rl) l
                     | None -> []) (pairs rs ls))

(** val families_of : region list -> support_leaf option list -> family list **)

let families_of rs ls =
  flatten
    (map0 (fun rl -> match snd rl with
                     | Some l -> families_in (fst rl) l
                     | None -> []) (pairs rs ls))

(** val open_of : region list -> support_leaf option list -> region list **)

let open_of rs ls =
  pmap (fun rl -> match snd rl with
                  | Some _ -> None
                  | None -> Some (fst rl)) (pairs rs ls)

(** val belongs : int -> yield -> family -> bool **)

let belongs n y f =
  (&&)
    (match (snd f).held_place with
     | PointAt v -> (&&) (rational v) (within (value_of y) ((start_of v), (end_of v)))
     | Between (v, v') ->
       (&&) (point_lt (end_of v) y.yield_from) (point_lt y.yield_to (start_of v'))
     | Above v -> point_lt (end_of v) y.yield_from) (all_same n y.yield_region (fst f))

(** val add_lists : ('a1 -> 'a1 -> 'a1) -> 'a1 list -> 'a1 list -> 'a1 list **)

let rec add_lists add p q =
  match p with
  | [] -> q
  | a :: p' -> (match q with
                | [] -> p
                | b :: q' -> (add a b) :: (add_lists add p' q'))

(** val add_matrix : matrix -> matrix -> matrix **)

let add_matrix =
  add_lists add_poly

(** val add_series : matrix list -> matrix list -> matrix list **)

let add_series =
  add_lists add_matrix

(** val scale_series : Big_int_Z.big_int -> matrix list -> matrix list **)

let scale_series c l =
  map0 (fun m -> map0 (fun row -> scale_poly c row) m) l

(** val product : sparse_row list -> matrix -> matrix **)

let product rows x =
  map0 (fun row -> combine_row x row) rows

(** val product_series : sparse_row list -> matrix list -> matrix list **)

let product_series rows l =
  map0 (fun x -> product rows x) l

(** val column_of : matrix -> int -> Big_int_Z.big_int list **)

let column_of x j =
  map0 (fun row -> nth Big_int_Z.zero_big_int row j) x

(** val columns_of : int -> matrix -> Big_int_Z.big_int list list **)

let columns_of n x =
  map0 (fun j -> column_of x j) (iota 0 n)

(** val cross : matrix -> matrix -> matrix **)

let cross cx cy =
  map0 (fun a -> map0 (fun b -> dot a b) cy) cx

(** val cross_series : int -> matrix list -> matrix list -> matrix list **)

let cross_series n x y =
  let cys = map0 (fun m -> columns_of n m) y in
  foldr (fun m s ->
    let cx = columns_of n m in add_series (map0 (fun cy -> cross cx cy) cys) ([] :: s)) [] x

(** val squares : Big_int_Z.big_int list -> Big_int_Z.big_int **)

let squares x =
  foldr (fun a s -> Big_int_Z.add_big_int (Big_int_Z.mult_big_int a a) s)
    Big_int_Z.zero_big_int x

(** val root_bits : Big_int_Z.big_int **)

let root_bits =
  let square = fun a -> Big_int_Z.mult_big_int a a in
  square
    (square
      (square
        (square
          (square (Big_int_Z.mult_int_big_int 2 (Big_int_Z.mult_int_big_int 2
            (Big_int_Z.mult_int_big_int 2 (Big_int_Z.mult_int_big_int 2
            (Big_int_Z.mult_int_big_int 2 (Big_int_Z.mult_int_big_int 2
            (Big_int_Z.mult_int_big_int 2 (Big_int_Z.mult_int_big_int 2
            Big_int_Z.unit_big_int))))))))))))

(** val refined : Big_int_Z.big_int -> Big_int_Z.big_int -> Big_int_Z.big_int **)

let refined x s =
  if (&&) (Z.ltb x root_bits)
       (Z.ltb x
         (Big_int_Z.mult_big_int (Big_int_Z.sub_big_int s Big_int_Z.unit_big_int)
           (Big_int_Z.sub_big_int s Big_int_Z.unit_big_int)))
  then Big_int_Z.sub_big_int s Big_int_Z.unit_big_int
  else s

(** val root_above : Big_int_Z.big_int -> Big_int_Z.big_int -> Big_int_Z.big_int **)

let rec root_above digits x =
  (fun f2p1 f2p f1 p ->
  if Big_int_Z.le_big_int p Big_int_Z.unit_big_int then f1 () else
  let (q,r) = Big_int_Z.quomod_big_int p (Big_int_Z.big_int_of_int 2) in
  if Big_int_Z.eq_big_int r Big_int_Z.zero_big_int then f2p q else f2p1 q)
    (fun d ->
    refined x
      (Big_int_Z.mult_big_int (Big_int_Z.mult_int_big_int 2 Big_int_Z.unit_big_int)
        (root_above d
          (Z.div x (Big_int_Z.mult_int_big_int 2 (Big_int_Z.mult_int_big_int 2
            Big_int_Z.unit_big_int))))))
    (fun d ->
    refined x
      (Big_int_Z.mult_big_int (Big_int_Z.mult_int_big_int 2 Big_int_Z.unit_big_int)
        (root_above d
          (Z.div x (Big_int_Z.mult_int_big_int 2 (Big_int_Z.mult_int_big_int 2
            Big_int_Z.unit_big_int))))))
    (fun _ -> Big_int_Z.add_big_int x Big_int_Z.unit_big_int)
    digits

(** val root_up : Big_int_Z.big_int -> Big_int_Z.big_int **)

let root_up x =
  (fun fO fp fn z -> let s = Big_int_Z.sign_big_int z in
  if s = 0 then fO () else if s > 0 then fp z
  else fn (Big_int_Z.minus_big_int z))
    (fun _ -> Big_int_Z.zero_big_int)
    (fun p -> root_above p (Big_int_Z.sub_big_int x Big_int_Z.unit_big_int))
    (fun _ -> Big_int_Z.zero_big_int)
    x

(** val norm2 : Big_int_Z.big_int list -> Big_int_Z.big_int **)

let norm2 x =
  root_up (squares x)

(** val norms0 : matrix list -> int -> polynomial **)

let norms0 l j =
  map0 (fun m -> norm2 (column_of m j)) l

(** val derivative : polynomial -> polynomial **)

let rec derivative = function
| [] -> []
| _ :: p' -> add_poly p' (Big_int_Z.zero_big_int :: (derivative p'))

(** val homogeneous :
    Big_int_Z.big_int -> Big_int_Z.big_int -> polynomial ->
    Big_int_Z.big_int * Big_int_Z.big_int **)

let homogeneous x y p =
  foldr (fun c s ->
    let power = Big_int_Z.mult_big_int (snd s) y in
    ((Big_int_Z.add_big_int (Big_int_Z.mult_big_int c power) (Big_int_Z.mult_big_int x (fst s))),
    power)) (Big_int_Z.zero_big_int, Big_int_Z.unit_big_int) p

(** val substituted :
    Big_int_Z.big_int -> Big_int_Z.big_int -> Big_int_Z.big_int -> polynomial ->
    polynomial * Big_int_Z.big_int **)

let substituted x v y p =
  foldr (fun c s ->
    let power = Big_int_Z.mult_big_int (snd s) y in
    ((add_poly ((Big_int_Z.mult_big_int c power) :: [])
       (add_poly (scale_poly x (fst s)) (Big_int_Z.zero_big_int :: (scale_poly v (fst s))))),
    power)) ([], Big_int_Z.unit_big_int) p

(** val spread_of : polynomial -> Big_int_Z.big_int **)

let rec spread_of = function
| [] -> Big_int_Z.zero_big_int
| _ :: p' -> Big_int_Z.add_big_int (norm1 p') (spread_of p')

(** val total : polynomial -> Big_int_Z.big_int **)

let total p =
  foldr Big_int_Z.add_big_int Big_int_Z.zero_big_int p

(** val constant_of : polynomial -> Big_int_Z.big_int **)

let constant_of p =
  nth Big_int_Z.zero_big_int p 0

(** val chord_of : polynomial -> Big_int_Z.big_int **)

let chord_of p =
  total (behead p)

(** val spread0 : polynomial -> Big_int_Z.big_int **)

let spread0 p =
  spread_of (behead p)

(** val poly_of : matrix list -> int -> int -> polynomial **)

let poly_of l i j =
  map0 (fun m -> entry m i j) l

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

(** val row_0 : pencil -> anchor -> int -> (int * Big_int_Z.big_int) list **)

let row_0 q a i =
  cat (times_row (snd a.anchor_center) (row_a q i))
    (times_row (fst a.anchor_center) (row_b q i))

(** val row_1 : pencil -> anchor -> int -> sparse_row **)

let row_1 q a i =
  times_row (snd a.anchor_center) (row_b q i)

(** val ff_block : pencil -> (int -> sparse_row) -> sparse_row list **)

let ff_block q row =
  let place0 = places q.free in map0 (fun i -> restrict place0 (row i)) q.free

(** val fs_block : pencil -> (int -> sparse_row) -> matrix **)

let fs_block q row =
  let columns = slip q in
  map0 (fun i -> let entries = row i in map0 (fun j -> lookup entries j) columns) q.free

(** val sf_block : pencil -> (int -> sparse_row) -> matrix **)

let sf_block q row =
  let rows = map0 row (slip q) in
  map0 (fun j -> map0 (fun entries -> lookup entries j) rows) q.free

(** val ss_block : pencil -> (int -> sparse_row) -> matrix **)

let ss_block q row =
  let columns = slip q in
  map0 (fun i -> let entries = row i in map0 (fun j -> lookup entries j) columns) columns

(** val residual_series :
    anchor -> Big_int_Z.big_int -> sparse_row list -> sparse_row list -> matrix list -> matrix
    list -> matrix list **)

let residual_series a sign0 f0 f1 y x =
  add_series (scale_series a.anchor_unit y)
    (scale_series sign0 (add_series (product_series f0 x) ([] :: (product_series f1 x))))

(** val residual_right : pencil -> anchor -> Big_int_Z.big_int -> matrix list **)

let residual_right q a sign0 =
  residual_series a sign0 (ff_block q (row_0 q a)) (ff_block q (row_1 q a))
    ((fs_block q (row_0 q a)) :: ((fs_block q (row_1 q a)) :: [])) a.anchor_right

(** val residual_left : pencil -> anchor -> Big_int_Z.big_int -> matrix list **)

let residual_left q a sign0 =
  residual_series a sign0 (transposed (ff_block q (row_0 q a)))
    (transposed (ff_block q (row_1 q a)))
    ((sf_block q (row_0 q a)) :: ((sf_block q (row_1 q a)) :: [])) a.anchor_left

(** val center_series : pencil -> anchor -> Big_int_Z.big_int -> matrix list -> matrix list **)

let center_series q a sign0 r =
  let u = a.anchor_unit in
  add_series
    (scale_series (Big_int_Z.mult_big_int u u)
      ((ss_block q (row_0 q a)) :: ((ss_block q (row_1 q a)) :: [])))
    (scale_series sign0
      (add_series
        (scale_series u
          (cross_series (size (slip q))
            ((sf_block q (row_0 q a)) :: ((sf_block q (row_1 q a)) :: [])) a.anchor_right))
        (cross_series (size (slip q)) a.anchor_left r)))

(** val row_sum : sparse_row -> Big_int_Z.big_int **)

let row_sum row =
  foldr (fun e s -> Big_int_Z.add_big_int (Big_int_Z.abs_big_int (snd e)) s)
    Big_int_Z.zero_big_int row

(** val expand_from :
    pencil -> anchor -> sparse_row list -> matrix list -> matrix list -> anchor_family **)

let expand_from q a sums l r =
  { series_z = (center_series q a (Big_int_Z.minus_big_int Big_int_Z.unit_big_int) r);
    left_norms = (map0 (fun i -> norms0 l i) (iota 0 (size (slip q)))); right_norms =
    (map0 (fun j -> norms0 r j) (iota 0 (size (slip q)))); drift =
    (foldr Big_int_Z.max_big_int Big_int_Z.zero_big_int (map0 row_sum sums)); spread_z = [] }

(** val small : pencil -> matrix list -> bool **)

let small q l =
  all (fun m -> leq (size m) (size q.free)) l

(** val expand : pencil -> anchor -> anchor_family option **)

let expand q a =
  let f0 = ff_block q (row_0 q a) in
  let f1 = ff_block q (row_1 q a) in
  let turned0 = transposed f1 in
  let l =
    residual_series a (Big_int_Z.minus_big_int Big_int_Z.unit_big_int) (transposed f0) turned0
      ((sf_block q (row_0 q a)) :: ((sf_block q (row_1 q a)) :: [])) a.anchor_left
  in
  let r =
    residual_series a (Big_int_Z.minus_big_int Big_int_Z.unit_big_int) f0 f1
      ((fs_block q (row_0 q a)) :: ((fs_block q (row_1 q a)) :: [])) a.anchor_right
  in
  if (&&) (Z.ltb Big_int_Z.zero_big_int (snd a.anchor_center))
       ((&&) (Z.ltb Big_int_Z.zero_big_int a.anchor_unit)
         ((&&)
           (all (fun i ->
             Z.ltb Big_int_Z.zero_big_int (nth Big_int_Z.zero_big_int a.anchor_scale i))
             (iota 0 (size (slip q))))
           ((&&) (small q a.anchor_left) ((&&) (small q l) (small q r)))))
  then Some (expand_from q a (cat f1 turned0) l r)
  else None

(** val radii_pencil : pencil -> (sparse_row list * sparse_row list) -> pencil **)

let radii_pencil q radii =
  { order = q.order; rows_a = (fst radii); rows_b = (snd radii); free = q.free }

(** val absolute : matrix list -> matrix list **)

let absolute l =
  map0 (fun m -> map0 (fun row -> map0 Big_int_Z.abs_big_int row) m) l

(** val absolute_anchor : anchor -> anchor **)

let absolute_anchor a =
  { anchor_center = a.anchor_center; anchor_unit = a.anchor_unit; anchor_right =
    (absolute a.anchor_right); anchor_left = (absolute a.anchor_left); anchor_scale =
    a.anchor_scale }

(** val widened_family :
    pencil -> anchor -> (sparse_row list * sparse_row list) -> anchor_family -> anchor_family
    option **)

let widened_family q a radii fam =
  let l = residual_left (radii_pencil q radii) (absolute_anchor a) Big_int_Z.unit_big_int in
  let r = residual_right (radii_pencil q radii) (absolute_anchor a) Big_int_Z.unit_big_int in
  let added = fun n l0 ->
    map0 (fun i -> add_poly (nth [] n i) (norms0 l0 i)) (iota 0 (size (slip q)))
  in
  if (&&) (small q l) (small q r)
  then Some { series_z = fam.series_z; left_norms = (added fam.left_norms l); right_norms =
         (added fam.right_norms r); drift = fam.drift; spread_z =
         (center_series (radii_pencil q radii) (absolute_anchor a) Big_int_Z.unit_big_int r) }
  else None

(** val expand_member :
    pencil -> (sparse_row list * sparse_row list) option -> anchor -> anchor_family option **)

let expand_member q radii a =
  match expand q a with
  | Some fam -> (match radii with
                 | Some rad -> widened_family q a rad fam
                 | None -> Some fam)
  | None -> None

(** val lowered : sparse_row list -> sparse_row list -> sparse_row list **)

let lowered rows radii =
  let turned0 = transposed radii in
  map0 (fun i -> (i,
    (Big_int_Z.minus_big_int
      (Big_int_Z.max_big_int (row_sum (nth [] radii i)) (row_sum (nth [] turned0 i))))) :: 
    (nth [] rows i)) (iota 0 (size rows))

(** val lowered_block :
    pencil -> (pencil -> int -> sparse_row) -> (sparse_row list * sparse_row list) option ->
    sparse_row list **)

let lowered_block q row radii =
  let block = ff_block q (row q) in
  (match radii with
   | Some rad -> lowered block (ff_block q (row (radii_pencil q rad)))
   | None -> block)

(** val interval_width : point -> point -> Big_int_Z.big_int **)

let interval_width lo hi =
  Big_int_Z.sub_big_int (Big_int_Z.mult_big_int (fst hi) (snd lo))
    (Big_int_Z.mult_big_int (fst lo) (snd hi))

(** val offset : anchor -> point -> point -> Big_int_Z.big_int **)

let offset a lo hi =
  Big_int_Z.mult_big_int
    (Big_int_Z.sub_big_int (Big_int_Z.mult_big_int (fst lo) (snd a.anchor_center))
      (Big_int_Z.mult_big_int (fst a.anchor_center) (snd lo))) (snd hi)

(** val extent : anchor -> point -> point -> Big_int_Z.big_int **)

let extent a lo hi =
  Big_int_Z.mult_big_int (interval_width lo hi) (snd a.anchor_center)

(** val unit_y : anchor -> point -> point -> Big_int_Z.big_int **)

let unit_y a lo hi =
  Big_int_Z.mult_big_int (Big_int_Z.mult_big_int (snd lo) (snd hi)) (snd a.anchor_center)

(** val reach : anchor -> point -> point -> Big_int_Z.big_int **)

let reach a lo hi =
  Big_int_Z.max_big_int (Big_int_Z.abs_big_int (offset a lo hi))
    (Big_int_Z.abs_big_int (Big_int_Z.add_big_int (offset a lo hi) (extent a lo hi)))

(** val lower_n : anchor -> form_bound -> form_bound -> point -> Big_int_Z.big_int **)

let lower_n a low_a low_b lo =
  Big_int_Z.mult_big_int (snd a.anchor_center)
    (Big_int_Z.add_big_int
      (Big_int_Z.mult_big_int (Big_int_Z.mult_big_int low_a.bound_at low_b.bound_times)
        (snd lo))
      (Big_int_Z.mult_big_int (Big_int_Z.mult_big_int (fst lo) low_b.bound_at)
        low_a.bound_times))

(** val lower_d : form_bound -> form_bound -> point -> Big_int_Z.big_int **)

let lower_d low_a low_b lo =
  Big_int_Z.mult_big_int (Big_int_Z.mult_big_int low_a.bound_times low_b.bound_times) (snd lo)

(** val proper_interval : anchor -> form_bound -> form_bound -> point -> point -> bool **)

let proper_interval a low_a low_b lo hi =
  (&&) (Z.leb Big_int_Z.zero_big_int (fst lo))
    ((&&) (Z.ltb Big_int_Z.zero_big_int (snd lo))
      ((&&) (Z.ltb Big_int_Z.zero_big_int (snd hi))
        ((&&) (Z.ltb Big_int_Z.zero_big_int (interval_width lo hi))
          (Z.ltb Big_int_Z.zero_big_int (lower_n a low_a low_b lo)))))

(** val remainder_radius :
    anchor -> form_bound -> form_bound -> point -> Big_int_Z.big_int ->
    (Big_int_Z.big_int * Big_int_Z.big_int) -> (Big_int_Z.big_int * Big_int_Z.big_int) ->
    Big_int_Z.big_int **)

let remainder_radius a low_a low_b lo power nl nr =
  divide_up
    (Big_int_Z.mult_big_int
      (Big_int_Z.mult_big_int (Big_int_Z.mult_big_int power (fst nl)) (fst nr))
      (lower_d low_a low_b lo))
    (Big_int_Z.mult_big_int (Big_int_Z.mult_big_int (snd nl) (snd nr))
      (lower_n a low_a low_b lo))

(** val remainder_slope :
    anchor -> form_bound -> form_bound -> anchor_family -> point -> point -> Big_int_Z.big_int
    -> (Big_int_Z.big_int * Big_int_Z.big_int) -> (Big_int_Z.big_int * Big_int_Z.big_int) ->
    (Big_int_Z.big_int * Big_int_Z.big_int) -> (Big_int_Z.big_int * Big_int_Z.big_int) ->
    Big_int_Z.big_int **)

let remainder_slope a low_a low_b fam lo hi power nl nr dl dr =
  Big_int_Z.add_big_int
    (Big_int_Z.add_big_int
      (divide_up
        (Big_int_Z.mult_big_int
          (Big_int_Z.mult_big_int
            (Big_int_Z.mult_big_int (Big_int_Z.mult_big_int power (extent a lo hi)) (fst dl))
            (fst nr)) (lower_d low_a low_b lo))
        (Big_int_Z.mult_big_int
          (Big_int_Z.mult_big_int (Big_int_Z.mult_big_int (unit_y a lo hi) (snd dl)) (snd nr))
          (lower_n a low_a low_b lo)))
      (divide_up
        (Big_int_Z.mult_big_int
          (Big_int_Z.mult_big_int
            (Big_int_Z.mult_big_int (Big_int_Z.mult_big_int power (extent a lo hi)) (fst nl))
            (fst dr)) (lower_d low_a low_b lo))
        (Big_int_Z.mult_big_int
          (Big_int_Z.mult_big_int (Big_int_Z.mult_big_int (unit_y a lo hi) (snd nl)) (snd dr))
          (lower_n a low_a low_b lo))))
    (divide_up
      (Big_int_Z.mult_big_int
        (Big_int_Z.mult_big_int
          (Big_int_Z.mult_big_int
            (Big_int_Z.mult_big_int
              (Big_int_Z.mult_big_int (Big_int_Z.mult_big_int power (extent a lo hi)) (fst nl))
              (fst nr)) fam.drift) (lower_d low_a low_b lo)) (lower_d low_a low_b lo))
      (Big_int_Z.mult_big_int
        (Big_int_Z.mult_big_int
          (Big_int_Z.mult_big_int (Big_int_Z.mult_big_int (unit_y a lo hi) (snd nl)) (snd nr))
          (lower_n a low_a low_b lo)) (lower_n a low_a low_b lo)))

(** val entry_of :
    anchor -> form_bound -> form_bound -> anchor_family -> point -> point -> bool -> polynomial
    -> (Big_int_Z.big_int * Big_int_Z.big_int) -> (Big_int_Z.big_int * Big_int_Z.big_int) ->
    (Big_int_Z.big_int * Big_int_Z.big_int) -> (Big_int_Z.big_int * Big_int_Z.big_int) ->
    (Big_int_Z.big_int * Big_int_Z.big_int) -> local_entry **)

let entry_of a low_a low_b fam lo hi slopes z0 nl nr dl dr e =
  let c = substituted (offset a lo hi) (extent a lo hi) (unit_y a lo hi) z0 in
  let rb =
    if slopes
    then Big_int_Z.add_big_int
           (Big_int_Z.mult_big_int (Big_int_Z.mult_int_big_int 2 (Big_int_Z.mult_int_big_int 2
             (Big_int_Z.mult_int_big_int 2 Big_int_Z.unit_big_int))) (spread0 (fst c)))
           (Big_int_Z.mult_big_int (Big_int_Z.mult_int_big_int 2 (Big_int_Z.mult_int_big_int 2
             Big_int_Z.unit_big_int))
             (remainder_slope a low_a low_b fam lo hi (snd c) nl nr dl dr))
    else Big_int_Z.zero_big_int
  in
  { local_a =
  (Big_int_Z.mult_big_int (Big_int_Z.mult_int_big_int 2 (Big_int_Z.mult_int_big_int 2
    Big_int_Z.unit_big_int)) (constant_of (fst c))); local_b =
  (Big_int_Z.mult_big_int (Big_int_Z.mult_int_big_int 2 (Big_int_Z.mult_int_big_int 2
    Big_int_Z.unit_big_int)) (chord_of (fst c))); local_ra =
  (Big_int_Z.add_big_int
    (Big_int_Z.add_big_int (spread0 (fst c))
      (Big_int_Z.mult_big_int (Big_int_Z.mult_int_big_int 2 (Big_int_Z.mult_int_big_int 2
        Big_int_Z.unit_big_int))
        (Big_int_Z.add_big_int (divide_up (Big_int_Z.mult_big_int (snd c) (fst e)) (snd e))
          (remainder_radius a low_a low_b lo (snd c) nl nr)))) rb); local_rb = rb }

(** val rounded : Big_int_Z.big_int -> Big_int_Z.big_int -> local_entry -> local_entry **)

let rounded grain scale e =
  { local_a = (Z.div (Big_int_Z.mult_big_int scale e.local_a) grain); local_b =
    (Z.div (Big_int_Z.mult_big_int scale e.local_b) grain); local_ra =
    (Big_int_Z.add_big_int (divide_up (Big_int_Z.mult_big_int scale e.local_ra) grain)
      Big_int_Z.unit_big_int); local_rb =
    (Big_int_Z.add_big_int (divide_up (Big_int_Z.mult_big_int scale e.local_rb) grain)
      Big_int_Z.unit_big_int) }

(** val local_entries :
    int -> anchor -> form_bound -> form_bound -> anchor_family -> point -> point -> bool ->
    Big_int_Z.big_int -> local_entry list list **)

let local_entries ns a low_a low_b fam lo hi slopes grain =
  let at_reach = homogeneous (reach a lo hi) (unit_y a lo hi) in
  let nl = map0 at_reach fam.left_norms in
  let nr = map0 at_reach fam.right_norms in
  let dl = map0 (fun n -> at_reach (derivative n)) fam.left_norms in
  let dr = map0 (fun n -> at_reach (derivative n)) fam.right_norms in
  let get = fun l i -> nth (Big_int_Z.zero_big_int, Big_int_Z.unit_big_int) l i in
  map0 (fun i ->
    map0 (fun j ->
      rounded grain (nth Big_int_Z.zero_big_int a.anchor_scale i)
        (entry_of a low_a low_b fam lo hi slopes (poly_of fam.series_z i j) (get nl i)
          (get nr j) (get dl i) (get dr j) (at_reach (poly_of fam.spread_z i j)))) (iota 0 ns))
    (iota 0 ns)

(** val local_pencil :
    int -> anchor -> form_bound -> form_bound -> anchor_family -> point -> point -> bool ->
    Big_int_Z.big_int -> enclosed **)

let local_pencil ns a low_a low_b fam lo hi slopes grain =
  let t = local_entries ns a low_a low_b fam lo hi slopes grain in
  let table0 = fun f -> map0 (fun row -> map0 f row) t in
  { size_of = ns; center_a = (table0 (fun l -> l.local_a)); center_b =
  (table0 (fun l -> l.local_b)); radius_a = (table0 (fun l -> l.local_ra)); radius_b =
  (table0 (fun l -> l.local_rb)) }

(** val local_point : point -> point -> point -> point **)

let local_point lo hi e =
  ((Big_int_Z.mult_big_int
     (Big_int_Z.sub_big_int (Big_int_Z.mult_big_int (fst e) (snd lo))
       (Big_int_Z.mult_big_int (fst lo) (snd e))) (snd hi)),
    (Big_int_Z.mult_big_int (snd e) (interval_width lo hi)))

(** val local_isolation : point -> point -> isolation -> isolation **)

let local_isolation lo hi c =
  { pivot = c.pivot; vector = c.vector; from_point = (local_point lo hi c.from_point);
    to_point = (local_point lo hi c.to_point); wide_box = c.wide_box; narrow_box =
    c.narrow_box; unique = c.unique; left_vector = c.left_vector }

(** val local_known : point -> point -> known -> known **)

let local_known lo hi q =
  { known_from = (local_point lo hi q.known_from); known_to = (local_point lo hi q.known_to);
    known_support = q.known_support; known_biactive = q.known_biactive }

(** val moved_leaf : point -> point -> local_leaf -> local_leaf **)

let moved_leaf lo hi l = match l with
| LocalRoot (c, o) -> LocalRoot ((local_isolation lo hi c), o)
| _ -> l

(** val wants_slopes : local_leaf -> bool **)

let wants_slopes = function
| LocalRoot (_, o) -> (match o with
                       | Solution -> true
                       | _ -> false)
| _ -> false

(** val local_region : region -> region **)

let local_region r =
  { lower = (Big_int_Z.zero_big_int, Big_int_Z.unit_big_int); upper = (Big_int_Z.unit_big_int,
    Big_int_Z.unit_big_int); states = r.states }

(** val check_local : enclosed -> region -> local_leaf -> bool **)

let check_local p r = function
| LocalFarkas w -> farkas p r w
| LocalDefinite (d, low, high) -> definite p d r low high
| LocalAbsent c -> check_absent p r c
| LocalRoot (c, o) -> check_root p r c o

(** val check_anchored :
    int -> anchor -> form_bound -> form_bound -> anchor_family -> point -> point -> region ->
    Big_int_Z.big_int -> local_leaf -> bool **)

let check_anchored ns a low_a low_b fam lo hi r grain l =
  (&&) (proper_interval a low_a low_b lo hi)
    ((&&) (Z.ltb Big_int_Z.zero_big_int grain)
      (check_local (local_pencil ns a low_a low_b fam lo hi (wants_slopes l) grain)
        (local_region r) (moved_leaf lo hi l)))

(** val check_anchored_claim :
    int -> anchor -> form_bound -> form_bound -> anchor_family -> point -> point -> region ->
    Big_int_Z.big_int -> pinning -> known -> bool **)

let check_anchored_claim ns a low_a low_b fam lo hi r grain c q =
  (&&) (proper_interval a low_a low_b lo hi)
    ((&&) (Z.ltb Big_int_Z.zero_big_int grain)
      (check_claimed (local_pencil ns a low_a low_b fam lo hi true grain) (local_region r) c
        (local_known lo hi q)))

(** val check_anchored_limit :
    int -> anchor -> form_bound -> form_bound -> anchor_family -> point -> point -> region ->
    Big_int_Z.big_int -> pinning -> bool **)

let check_anchored_limit ns a low_a low_b fam lo hi r grain c =
  (&&) (proper_interval a low_a low_b lo hi)
    ((&&) (Z.ltb Big_int_Z.zero_big_int grain)
      (pinned (local_pencil ns a low_a low_b fam lo hi true grain) (local_region r) c))

type anchoring = { stiffness_bound : form_bound; mass_bound : form_bound;
                   anchors : (bool * anchor) list }

type varying_leaf =
| OfAnchor of int * Big_int_Z.big_int * interval * local_leaf
| OfClaim of int * Big_int_Z.big_int * interval * pinning * int
| OfLimit of int * Big_int_Z.big_int * interval * pinning * Big_int_Z.big_int list
| OfWhole of whole
| LeftOpen

(** val swap_pencil : pencil -> pencil **)

let swap_pencil q =
  { order = q.order; rows_a = q.rows_b; rows_b = q.rows_a; free = q.free }

(** val swap_region : region -> region **)

let swap_region r =
  { lower = (swap r.upper); upper = (swap r.lower); states = r.states }

(** val swap_isolation : isolation -> isolation **)

let swap_isolation c =
  { pivot = c.pivot; vector = c.vector; from_point = (swap c.to_point); to_point =
    (swap c.from_point); wide_box = c.wide_box; narrow_box = c.narrow_box; unique = c.unique;
    left_vector = c.left_vector }

(** val swap_leaf : local_leaf -> local_leaf **)

let swap_leaf l = match l with
| LocalRoot (c, o) -> LocalRoot ((swap_isolation c), o)
| _ -> l

(** val swap_known : known -> known **)

let swap_known q =
  { known_from = (swap q.known_to); known_to = (swap q.known_from); known_support =
    q.known_support; known_biactive = q.known_biactive }

(** val expand_anchor : pencil -> (bool * anchor) -> anchor_family option **)

let expand_anchor q ra =
  if fst ra then expand (swap_pencil q) (snd ra) else expand q (snd ra)

(** val no_anchor : bool * anchor **)

let no_anchor =
  (false, { anchor_center = zero; anchor_unit = Big_int_Z.zero_big_int; anchor_right = [];
    anchor_left = []; anchor_scale = [] })

(** val expansions : pencil -> anchoring -> anchor_family option list **)

let expansions q w =
  map0 (fun ra -> expand_anchor q ra) w.anchors

(** val finite_root : local_leaf -> bool **)

let finite_root = function
| LocalRoot (c, _) -> Z.ltb Big_int_Z.zero_big_int (snd c.to_point)
| _ -> true

(** val at_anchor :
    anchoring -> anchor_family option list -> int -> region -> (bool -> anchor -> form_bound ->
    form_bound -> anchor_family -> region -> bool) -> bool **)

let at_anchor w families0 n r check =
  let (reverse, a) = nth no_anchor w.anchors n in
  (match nth None families0 n with
   | Some fam ->
     if reverse
     then (&&) (Z.ltb Big_int_Z.zero_big_int (fst r.lower))
            (check true a w.mass_bound w.stiffness_bound fam (swap_region r))
     else check false a w.stiffness_bound w.mass_bound fam r
   | None -> false)

(** val leaf_at :
    pencil -> Big_int_Z.big_int -> local_leaf -> bool -> anchor -> form_bound -> form_bound ->
    anchor_family -> region -> bool **)

let leaf_at q grain e reverse a low_a low_b fam r =
  (&&) ((||) (negb reverse) (finite_root e))
    (check_anchored (size (slip q)) a low_a low_b fam r.lower r.upper r grain
      (if reverse then swap_leaf e else e))

(** val claim_at :
    pencil -> Big_int_Z.big_int -> pinning -> known -> bool -> anchor -> form_bound ->
    form_bound -> anchor_family -> region -> bool **)

let claim_at q grain c q0 reverse a low_a low_b fam r =
  (&&) ((||) (negb reverse) (Z.ltb Big_int_Z.zero_big_int (fst q0.known_from)))
    (check_anchored_claim (size (slip q)) a low_a low_b fam r.lower r.upper r grain c
      (if reverse then swap_known q0 else q0))

(** val limit_at :
    pencil -> Big_int_Z.big_int -> pinning -> Big_int_Z.big_int list -> bool -> anchor ->
    form_bound -> form_bound -> anchor_family -> region -> bool **)

let limit_at q grain c x reverse a low_a low_b fam r =
  (&&) reverse
    ((&&) (Big_int_Z.eq_big_int (fst r.lower) Big_int_Z.zero_big_int)
      ((&&) (check_null q (row_b q) r c.pin_pivot x)
        (check_anchored_limit (size (slip q)) a low_a low_b fam r.lower r.upper r grain c)))

(** val check_varying_leaf :
    pencil -> anchoring -> anchor_family option list -> known list -> region -> varying_leaf ->
    bool **)

let check_varying_leaf q w families0 solutions r = function
| OfAnchor (n, grain, h, e) ->
  (&&) (reaches r h) (at_anchor w families0 n (extended r h) (leaf_at q grain e))
| OfClaim (n, grain, h, c, k) ->
  (&&) (reaches r h)
    ((&&) (leq (Natural.succ k) (size solutions))
      (at_anchor w families0 n (extended r h) (claim_at q grain c (known_at solutions k))))
| OfLimit (n, grain, h, c, x) ->
  (&&) (reaches r h) (at_anchor w families0 n (extended r h) (limit_at q grain c x))
| OfWhole e -> check_whole q r e
| LeftOpen -> true

(** val bounds_hold : pencil -> anchoring -> bool **)

let bounds_hold q w =
  (&&) (bounded_rows (Obj.magic size q.free) (ff_block q (row_a q)) w.stiffness_bound)
    (bounded_rows (Obj.magic size q.free) (ff_block q (row_b q)) w.mass_bound)

(** val check_varying :
    pencil -> solution_claim list -> anchoring -> varying_leaf tree -> point -> point -> bool **)

let check_varying q claims w tr lo hi =
  let families0 = expansions q w in
  let solutions = known_solutions q claims in
  (&&) (wellformed q)
    ((&&) ((||) (nilp w.anchors) (bounds_hold q w))
      ((&&) (all (check_solution_claim q) claims)
        (check_tree (size (slip q)) (check_varying_leaf q w families0 solutions) tr
          (window lo hi))))

(** val claim_yield : pencil -> region -> known -> yield option **)

let claim_yield q r q0 =
  if supports_region (enclosed_order (size (slip q))) r q0
  then Some { yield_region = r; yield_from = q0.known_from; yield_to = q0.known_to }
  else None

(** val varying_yield :
    pencil -> solution_claim list -> (region * varying_leaf) -> yield option **)

let varying_yield q claims rl =
  match snd rl with
  | OfAnchor (_, _, h, l) ->
    (match l with
     | LocalRoot (c, o) ->
       (match o with
        | Solution ->
          Some { yield_region = (extended (fst rl) h); yield_from = c.from_point; yield_to =
            c.to_point }
        | _ -> None)
     | _ -> None)
  | OfClaim (_, _, h, _, k) ->
    claim_yield q (extended (fst rl) h) (known_at (known_solutions q claims) k)
  | _ -> None

(** val varying_found :
    pencil -> solution_claim list -> varying_leaf tree -> point -> point -> yield list **)

let varying_found q claims tr lo hi =
  pmap (varying_yield q claims) (leaves tr (window lo hi))

(** val varying_open : varying_leaf tree -> point -> point -> region list **)

let varying_open tr lo hi =
  pmap (fun rl -> match snd rl with
                  | LeftOpen -> Some (fst rl)
                  | _ -> None) (leaves tr (window lo hi))

type cover =
| Eliminated of elimination * whole leaf tree
| Anchored of anchoring * varying_leaf tree

(** val check_cover_of : pencil -> solution_claim list -> cover -> point -> point -> bool **)

let check_cover_of q claims c lo hi =
  match c with
  | Eliminated (w, tr) -> check_complete q claims w tr lo hi
  | Anchored (w, tr) -> check_varying q claims w tr lo hi

(** val regions_found :
    pencil -> solution_claim list -> cover -> point -> point -> yield list **)

let regions_found q claims c lo hi =
  match c with
  | Eliminated (_, tr) -> found q claims tr lo hi
  | Anchored (_, tr) -> varying_found q claims tr lo hi

(** val regions_open : cover -> point -> point -> region list **)

let regions_open c lo hi =
  match c with
  | Eliminated (_, tr) -> left_open tr lo hi
  | Anchored (_, tr) -> varying_open tr lo hi

(** val families : cover -> point -> point -> support_leaf option list -> family list **)

let families c lo hi ls =
  families_of (regions_open c lo hi) ls

(** val still_open : cover -> point -> point -> support_leaf option list -> region list **)

let still_open c lo hi ls =
  open_of (regions_open c lo hi) ls

(** val all_solutions :
    pencil -> solution_claim list -> cover -> point -> point -> support_leaf option list ->
    yield list option **)

let all_solutions q claims c lo hi ls =
  distinct_yields (size (slip q)) lo hi
    (filter (fun y -> negb (has (belongs (size (slip q)) y) (families c lo hi ls)))
      (cat (regions_found q claims c lo hi) (isolated_of (regions_open c lo hi) ls)))

(** val check_families :
    pencil -> solution_claim list -> cover -> point -> point -> support_leaf option list -> bool **)

let check_families q claims c lo hi ls =
  (&&) (check_cover_of q claims c lo hi) (check_supports q (regions_open c lo hi) ls)

(** val mixed_matrix : point -> matrix -> matrix -> matrix **)

let mixed_matrix e m m' =
  add_matrix (map0 (fun row -> scale_poly (snd e) row) m)
    (map0 (fun row -> scale_poly (fst e) row) m')

(** val mixed : point -> enclosed -> enclosed -> enclosed **)

let mixed e p p' =
  { size_of = p.size_of; center_a = (mixed_matrix e p.center_a p'.center_a); center_b =
    (mixed_matrix e p.center_b p'.center_b); radius_a =
    (mixed_matrix e p.radius_a p'.radius_a); radius_b =
    (mixed_matrix e p.radius_b p'.radius_b) }

type regular = { regular_pivot : int; regular_inverse : matrix;
                 regular_units : Big_int_Z.big_int list; regular_left : Big_int_Z.big_int list;
                 regular_right : Big_int_Z.big_int list;
                 regular_widths : Big_int_Z.big_int list; regular_minus : bool }

(** val combine_rows : Big_int_Z.big_int list -> matrix -> Big_int_Z.big_int list **)

let combine_rows c rows =
  foldr (fun e sum0 -> add_poly (scale_poly (fst e) (snd e)) sum0) [] (zip c rows)

(** val against_right : int -> regular -> Big_int_Z.big_int list -> Big_int_Z.big_int **)

let against_right m w p =
  sumZ (iota 0 (Natural.succ m)) (fun j ->
    Big_int_Z.mult_big_int (nth Big_int_Z.zero_big_int p j)
      (nth Big_int_Z.zero_big_int w.regular_right j))

(** val against_radius : int -> regular -> Big_int_Z.big_int list -> Big_int_Z.big_int **)

let against_radius m w r =
  sumZ (iota 0 (Natural.succ m)) (fun j ->
    Big_int_Z.mult_big_int (nth Big_int_Z.zero_big_int r j)
      (Big_int_Z.abs_big_int (nth Big_int_Z.zero_big_int w.regular_right j)))

(** val off_pivot :
    int -> regular -> Big_int_Z.big_int -> int -> Big_int_Z.big_int list -> Big_int_Z.big_int
    list -> Big_int_Z.big_int **)

let off_pivot m w u i p r =
  sumZ (iota 0 m) (fun j ->
    Big_int_Z.mult_big_int
      (Big_int_Z.add_big_int
        (Big_int_Z.abs_big_int
          (Big_int_Z.sub_big_int (unit_entry u i j)
            (nth Big_int_Z.zero_big_int p (Natural.succ j))))
        (nth Big_int_Z.zero_big_int r (Natural.succ j)))
      (nth Big_int_Z.zero_big_int w.regular_widths j))

(** val regular_row0 :
    int -> regular -> matrix -> matrix -> Big_int_Z.big_int -> int -> bool **)

let regular_row0 m w m0 rd u i =
  let y = nth [] w.regular_inverse i in
  let p = combine_rows y (behead m0) in
  let r = combine_rows (map0 Big_int_Z.abs_big_int y) (behead rd) in
  Z.ltb
    (Big_int_Z.add_big_int (off_pivot m w u i p r)
      (Big_int_Z.add_big_int (Big_int_Z.abs_big_int (against_right m w p))
        (against_radius m w r)))
    (Big_int_Z.mult_big_int u (nth Big_int_Z.zero_big_int w.regular_widths i))

(** val regular_rows : int -> regular -> matrix -> matrix -> Big_int_Z.big_int -> bool **)

let regular_rows m w m0 rd u =
  (&&) (Z.ltb Big_int_Z.zero_big_int u)
    ((&&)
      (all (fun i ->
        Z.ltb Big_int_Z.zero_big_int (nth Big_int_Z.zero_big_int w.regular_widths i))
        (iota 0 m)) (all (regular_row0 m w m0 rd u) (iota 0 m)))

(** val row_slack :
    int -> regular -> Big_int_Z.big_int list -> Big_int_Z.big_int list -> Big_int_Z.big_int **)

let row_slack m w p r =
  Big_int_Z.add_big_int (against_radius m w r) (off_pivot m w Big_int_Z.zero_big_int 0 p r)

(** val regular_sign : int -> regular -> matrix -> matrix -> bool **)

let regular_sign m w m0 rd =
  let p = combine_rows w.regular_left m0 in
  let r = combine_rows (map0 Big_int_Z.abs_big_int w.regular_left) rd in
  let h = against_right m w p in
  Z.ltb (row_slack m w p r) (if w.regular_minus then Big_int_Z.minus_big_int h else h)

(** val regular_order : enclosed -> region -> Equality.sort -> int list **)

let regular_order p r k =
  (Obj.magic k) :: (Obj.magic others p r k)

(** val restricted : int list -> (int -> int -> Big_int_Z.big_int) -> matrix **)

let restricted l f =
  map0 (fun i -> map0 (fun j -> f i j) l) l

(** val corner_pencil : enclosed -> enclosed -> int -> enclosed **)

let corner_pencil p p' c =
  if leq (Natural.succ c) (Natural.succ (Natural.succ 0)) then p else p'

(** val corner_end : region -> int -> point **)

let corner_end r c =
  if odd c then r.upper else r.lower

(** val corner_center : enclosed -> enclosed -> region -> int list -> int -> matrix **)

let corner_center p p' r l c =
  restricted l (center (corner_pencil p p' c) (corner_end r c))

(** val corner_radius : enclosed -> enclosed -> region -> int list -> int -> matrix **)

let corner_radius p p' r l c =
  restricted l (radius (corner_pencil p p' c) (corner_end r c))

(** val rows_at : enclosed -> enclosed -> region -> int list -> regular -> int -> bool **)

let rows_at p p' r l w c =
  regular_rows (pred (size l)) w (corner_center p p' r l c) (corner_radius p p' r l c)
    (nth Big_int_Z.zero_big_int w.regular_units c)

(** val sign_at0 : enclosed -> enclosed -> region -> int list -> regular -> int -> bool **)

let sign_at0 p p' r l w c =
  regular_sign (pred (size l)) w (corner_center p p' r l c) (corner_radius p p' r l c)

(** val four_corners : int list **)

let four_corners =
  0 :: ((Natural.succ 0) :: ((Natural.succ (Natural.succ 0)) :: ((Natural.succ (Natural.succ
    (Natural.succ 0))) :: [])))

(** val box_regular : enclosed -> enclosed -> region -> regular -> bool **)

let box_regular p p' r w =
  let l = regular_order p r (Obj.magic w.regular_pivot) in
  (&&) (decided p r)
    ((&&)
      (in_mem (Obj.magic w.regular_pivot)
        (mem (seq_predType nat_eqType) (Obj.magic moving p r)))
      ((&&) (Z.ltb Big_int_Z.zero_big_int (nth Big_int_Z.zero_big_int w.regular_right 0))
        (all (fun c -> (&&) (rows_at p p' r l w c) (sign_at0 p p' r l w c)) four_corners)))

(** val zero_firsts : zero_system -> int list **)

let zero_firsts z0 =
  map0 (fun p -> p.first_dof) z0.zero_particles

(** val zero_seconds : zero_system -> int list **)

let zero_seconds z0 =
  map0 (fun p -> p.second_dof) z0.zero_particles

(** val turned : slip_particle -> planar **)

let turned p =
  ((Big_int_Z.minus_big_int (snd p.tangent)), (fst p.tangent))

(** val unit_normal : slip_particle -> planar **)

let unit_normal p =
  if Z.ltb Big_int_Z.zero_big_int (inner p.normal (turned p))
  then turned p
  else ((Big_int_Z.minus_big_int (fst (turned p))), (Big_int_Z.minus_big_int (snd (turned p))))

(** val three_columns :
    zero_system -> int -> Big_int_Z.big_int -> Big_int_Z.big_int -> sparse_row **)

let three_columns z0 j n t =
  ((gap z0 j), (Big_int_Z.minus_big_int n)) :: (((right z0 j), t) :: (((left z0 j),
    (Big_int_Z.minus_big_int t)) :: []))

(** val zero_columns : zero_system -> Equality.sort -> sparse_row **)

let zero_columns z0 d =
  if in_mem d (mem (seq_predType nat_eqType) (Obj.magic zero_firsts z0))
  then let j = index nat_eqType d (Obj.magic zero_firsts z0) in
       let p = zero_particle z0 j in three_columns z0 j (fst (unit_normal p)) (fst p.tangent)
  else if in_mem d (mem (seq_predType nat_eqType) (Obj.magic zero_seconds z0))
       then let j = index nat_eqType d (Obj.magic zero_seconds z0) in
            let p = zero_particle z0 j in
            three_columns z0 j (snd (unit_normal p)) (snd p.tangent)
       else (match column z0.without_zero d with
             | Some c -> c :: []
             | None -> [])

(** val zero_table : zero_system -> sparse_row list **)

let zero_table z0 =
  map0 (fun d -> zero_columns z0 (Obj.magic d)) (iota 0 z0.without_zero.dofs)

(** val row_multiple : unknown -> Big_int_Z.big_int **)

let row_multiple = function
| Mu -> Big_int_Z.unit_big_int
| Lambda2 (_, q) -> q

(** val scaled_normal : unknown -> slip_particle -> planar **)

let scaled_normal u p =
  ((Big_int_Z.mult_big_int (row_multiple u) (fst (unit_normal p))),
    (Big_int_Z.mult_big_int (row_multiple u) (snd (unit_normal p))))

(** val zero_forms : zero_system -> unknown -> int -> linear_form list **)

let zero_forms z0 u j =
  let p = zero_particle z0 j in
  (negative (pressing_form z0.without_zero u (scaled_normal u p) p)) :: ((negative
                                                                           (cone_form
                                                                             z0.without_zero u
                                                                             (with_sign
                                                                               (Big_int_Z.minus_big_int
                                                                               Big_int_Z.unit_big_int)
                                                                               p))) :: (
  (negative (cone_form z0.without_zero u (with_sign Big_int_Z.unit_big_int p))) :: []))

(** val variable_forms : zero_system -> unknown -> linear_form list **)

let variable_forms z0 u =
  cat (map0 (fun d -> force_form z0.without_zero u d) z0.without_zero.free_dofs)
    (cat (map0 (fun p -> negative (cone_form z0.without_zero u p)) z0.without_zero.particles)
      (flatten (map0 (fun j -> zero_forms z0 u j) (iota 0 (size z0.zero_particles)))))

(** val zero_pencil : zero_system -> unknown -> pencil **)

let zero_pencil z0 u =
  pencil_of_forms (zero_table z0)
    (addn (addn (free_number z0.without_zero) (size z0.without_zero.particles))
      (muln (Natural.succ (Natural.succ (Natural.succ 0))) (size z0.zero_particles)))
    (variable_forms z0 u) (iota 0 (free_number z0.without_zero))

(** val part_plain : zero_system -> pencil **)

let part_plain z0 =
  zero_pencil z0 (Lambda2 (Big_int_Z.zero_big_int, Big_int_Z.unit_big_int))

(** val part_friction : zero_system -> pencil **)

let part_friction z0 =
  zero_pencil z0 (Lambda2 (Big_int_Z.unit_big_int, Big_int_Z.zero_big_int))

(** val slip_number : zero_system -> int **)

let slip_number z0 =
  addn (size z0.without_zero.particles)
    (muln (Natural.succ (Natural.succ (Natural.succ 0))) (size z0.zero_particles))

(** val half_state : zero_system -> region -> int -> state **)

let half_state z0 r i =
  state_of r (subn i (free_number z0.without_zero))

(** val halves_apart : zero_system -> region -> bool **)

let halves_apart z0 r =
  all (fun j ->
    (||) (is_resting (half_state z0 r (right z0 j))) (is_resting (half_state z0 r (left z0 j))))
    (iota 0 (size z0.zero_particles))

(** val both_halves : zero_system -> region -> bool **)

let both_halves z0 r =
  has (fun j ->
    (&&) (is_moving (half_state z0 r (right z0 j))) (is_moving (half_state z0 r (left z0 j))))
    (iota 0 (size z0.zero_particles))

type critical_leaf =
| BoxFarkas of Big_int_Z.big_int list
| BoxDefinite of Big_int_Z.big_int list * (factor * factor) * (factor * factor)
| BoxRegular of regular
| BoxWhole of whole * whole
| BoxSigned of Big_int_Z.big_int * signed_ends * signed_ends
| BoxHalves

(** val check_parts :
    enclosed -> enclosed -> region -> point -> point -> critical_leaf -> bool **)

let check_parts p p' r low high = function
| BoxFarkas v -> box_farkas (mixed low p p') (mixed high p p') r v
| BoxDefinite (d, f, f') -> box_definite (mixed low p p') (mixed high p p') r d f f'
| BoxRegular v -> box_regular (mixed low p p') (mixed high p p') r v
| _ -> false

(** val freed : zero_system -> zero_system **)

let freed z0 =
  let s = z0.without_zero in
  { without_zero = { dofs = s.dofs; stiffness = s.stiffness; mass = s.mass; free_dofs =
  (filter (fun d ->
    in_mem (Obj.magic d)
      (mem (seq_predType nat_eqType) (Obj.magic cat s.free_dofs (zero_dofs z0))))
    (iota 0 s.dofs)); particles = s.particles; unit_length = s.unit_length }; zero_particles =
  [] }

(** val pencil_at : zero_system -> point -> pencil **)

let pencil_at z0 e =
  zero_pencil (freed z0) (Lambda2 ((fst e), (snd e)))

(** val same_weights : zero_system -> whole -> whole -> bool **)

let same_weights z0 a b =
  all (fun i ->
    Big_int_Z.eq_big_int (nth Big_int_Z.unit_big_int a.whole_weights i)
      (nth Big_int_Z.unit_big_int b.whole_weights i))
    (iota (free_number (freed z0).without_zero) (size z0.without_zero.particles))

(** val freed_weight : zero_system -> whole -> Equality.sort -> Big_int_Z.big_int **)

let freed_weight z0 a d =
  nth Big_int_Z.unit_big_int a.whole_weights
    (index nat_eqType d (Obj.magic (freed z0).without_zero.free_dofs))

(** val zero_weights : zero_system -> whole -> bool **)

let zero_weights z0 a =
  all (fun p ->
    (&&) (Z.leb Big_int_Z.zero_big_int (freed_weight z0 a (Obj.magic p.first_dof)))
      (Big_int_Z.eq_big_int (freed_weight z0 a (Obj.magic p.first_dof))
        (freed_weight z0 a (Obj.magic p.second_dof)))) z0.zero_particles

(** val check_whole_leaf : zero_system -> region -> point -> point -> critical_leaf -> bool **)

let check_whole_leaf z0 r low high = function
| BoxWhole (a, b) ->
  (&&) (same_weights z0 a b)
    ((&&) (zero_weights z0 a)
      ((&&) (zero_weights z0 b)
        ((&&) (check_whole (pencil_at z0 low) r a) (check_whole (pencil_at z0 high) r b))))
| BoxHalves -> both_halves z0 r
| _ -> false

(** val with_left : elimination -> (matrix * matrix) -> elimination **)

let with_left w other =
  { row_scale = w.row_scale; unit_of = w.unit_of; right_w = w.right_w; left_va = (fst other);
    left_vb = (snd other); bound_c = w.bound_c; bound_d = w.bound_d; factor_scale =
    w.factor_scale; stiffness_factor = w.stiffness_factor }

(** val condensed_parts :
    zero_system -> (elimination * (matrix * matrix)) option -> (enclosed * enclosed) option **)

let condensed_parts z0 w =
  Option.map (fun wl -> ((condensed (blocks_of (part_plain z0)) (fst wl)),
    (condensed (blocks_of (part_friction z0)) (with_left (fst wl) (snd wl))))) w

(** val parts_eliminated : zero_system -> (elimination * (matrix * matrix)) option -> bool **)

let parts_eliminated z0 = function
| Some p ->
  let (w0, other) = p in
  (&&) (free_rows_constant (part_plain z0))
    ((&&) (free_rows_constant (part_friction z0))
      ((&&) (check_elimination (blocks_of (part_plain z0)) w0)
        (check_elimination (blocks_of (part_friction z0)) (with_left w0 other))))
| None -> true

(** val check_critical_leaf :
    zero_system -> (enclosed * enclosed) option -> region -> point -> point -> critical_leaf ->
    bool **)

let check_critical_leaf z0 parts r low high l =
  (||)
    (match parts with
     | Some p -> let (p0, p1) = p in check_parts p0 p1 r low high l
     | None -> false) (check_whole_leaf z0 r low high l)

(** val check_critical :
    zero_system -> (elimination * (matrix * matrix)) option -> critical_leaf tree -> point ->
    point -> bool **)

let check_critical z0 w tr from bound1 =
  let parts = condensed_parts z0 w in
  (&&) (zero_wellformed z0 Mu)
    ((&&) (parts_eliminated z0 w)
      (check_boxes (slip_number z0) (check_critical_leaf z0 parts) tr (window zero infinity)
        from bound1))

type box_anchor = { reversed_anchor : bool; plain_anchor : anchor; friction_left : matrix list }

type box_anchoring = { stiffness_below : form_bound; mass_below : form_bound;
                       box_anchors : box_anchor list }

type anchored_box_leaf =
| AboutAnchor of int * Big_int_Z.big_int * critical_leaf tree
| WithoutAnchor of critical_leaf

type part_radii = { plain_radii : (sparse_row list * sparse_row list);
                    friction_radii : (sparse_row list * sparse_row list);
                    friction_shares : Big_int_Z.big_int list; share_unit : Big_int_Z.big_int }

(** val widened : part_radii option -> enclosed -> enclosed **)

let widened radii p =
  match radii with
  | Some rad ->
    let ix = iota 0 p.size_of in
    let wider = fun center0 radius0 ->
      map0 (fun i ->
        let share = nth Big_int_Z.zero_big_int rad.friction_shares i in
        map0 (fun j ->
          let r = entry radius0 i j in
          Big_int_Z.add_big_int r
            (divide_up
              (Big_int_Z.mult_big_int share
                (Big_int_Z.add_big_int (Big_int_Z.abs_big_int (entry center0 i j)) r))
              rad.share_unit)) ix) ix
    in
    { size_of = p.size_of; center_a = p.center_a; center_b = p.center_b; radius_a =
    (wider p.center_a p.radius_a); radius_b = (wider p.center_b p.radius_b) }
  | None -> p

(** val exact_part :
    int -> Big_int_Z.big_int -> pencil -> (sparse_row list * sparse_row list) -> enclosed **)

let exact_part first factor0 q radii =
  let ix = iota 0 q.order in
  let times = fun i v ->
    if leq (Natural.succ i) first then Big_int_Z.mult_big_int factor0 v else v
  in
  let table0 = fun rows ->
    map0 (fun i -> map0 (fun j -> times i (lookup (nth [] rows i) j)) ix) ix
  in
  { size_of = q.order; center_a = (table0 q.rows_a); center_b = (table0 q.rows_b); radius_a =
  (table0 (fst radii)); radius_b = (table0 (snd radii)) }

(** val radii_of_all : int -> part_radii -> part_radii **)

let radii_of_all nf radii =
  { plain_radii = radii.plain_radii; friction_radii = radii.friction_radii; friction_shares =
    (cat (nseq nf Big_int_Z.zero_big_int) radii.friction_shares); share_unit =
    radii.share_unit }

(** val swapped_radii :
    (sparse_row list * sparse_row list) option -> (sparse_row list * sparse_row list) option **)

let swapped_radii radii =
  Option.map (fun rad -> ((snd rad), (fst rad))) radii

(** val friction_anchor : anchor -> matrix list -> anchor **)

let friction_anchor a other =
  { anchor_center = a.anchor_center; anchor_unit = a.anchor_unit; anchor_right =
    a.anchor_right; anchor_left = other; anchor_scale = a.anchor_scale }

(** val expand_part :
    pencil -> (sparse_row list * sparse_row list) option -> bool -> anchor -> anchor_family
    option **)

let expand_part q rad reverse a =
  if reverse then expand_member (swap_pencil q) (swapped_radii rad) a else expand_member q rad a

(** val expand_box :
    zero_system -> part_radii option -> box_anchor -> (anchor_family * anchor_family) option **)

let expand_box z0 radii b =
  match expand_part (part_plain z0) (Option.map (fun p -> p.plain_radii) radii)
          b.reversed_anchor b.plain_anchor with
  | Some fam ->
    (match expand_part (part_friction z0) (Option.map (fun p -> p.friction_radii) radii)
             b.reversed_anchor (friction_anchor b.plain_anchor b.friction_left) with
     | Some fam' -> Some (fam, fam')
     | None -> None)
  | None -> None

(** val check_local_leaf :
    (region -> bool) -> enclosed -> enclosed -> region -> point -> point -> critical_leaf ->
    bool **)

let check_local_leaf halves p p' r low high l = match l with
| BoxHalves -> halves r
| _ -> check_parts p p' r low high l

(** val local_part :
    zero_system -> form_bound -> form_bound -> anchor -> anchor_family -> point -> point ->
    Big_int_Z.big_int -> enclosed **)

let local_part z0 low_a low_b a fam lo hi grain =
  local_pencil (slip_number z0) a low_a low_b fam lo hi false grain

(** val check_about :
    zero_system -> part_radii option -> form_bound -> form_bound -> box_anchor ->
    (anchor_family * anchor_family) -> Big_int_Z.big_int -> region -> point -> point ->
    critical_leaf tree -> bool **)

let check_about z0 radii low_a low_b b fams grain r low high tr =
  let a = b.plain_anchor in
  let a' = friction_anchor a b.friction_left in
  (&&) (proper_interval a low_a low_b r.lower r.upper)
    ((&&) (Z.ltb Big_int_Z.zero_big_int grain)
      ((&&)
        (eq_op nat_eqType (Obj.magic size (fst fams).series_z)
          (Obj.magic size (snd fams).series_z))
        (check_boxes (slip_number z0)
          (check_local_leaf (both_halves z0)
            (local_part z0 low_a low_b a (fst fams) r.lower r.upper grain)
            (widened radii (local_part z0 low_a low_b a' (snd fams) r.lower r.upper grain))) tr
          (local_region r) low high)))

(** val check_exact :
    zero_system -> part_radii -> region -> point -> point -> critical_leaf -> bool **)

let check_exact z0 rad r low high l =
  let nf = size (part_plain z0).free in
  let p' =
    widened (Some (radii_of_all nf rad))
      (exact_part nf Big_int_Z.zero_big_int (part_friction z0) rad.friction_radii)
  in
  (match l with
   | BoxSigned (factor0, f, f') ->
     let p = exact_part nf factor0 (part_plain z0) rad.plain_radii in
     (&&) (Z.leb Big_int_Z.zero_big_int factor0)
       (box_signed (mixed low p p') (mixed high p p') r f f')
   | _ ->
     (&&) (nilp (part_plain z0).free)
       (check_parts (exact_part 0 Big_int_Z.zero_big_int (part_plain z0) rad.plain_radii) p' r
         low high l))

(** val no_box_anchor : box_anchor **)

let no_box_anchor =
  { reversed_anchor = false; plain_anchor = { anchor_center = zero; anchor_unit =
    Big_int_Z.zero_big_int; anchor_right = []; anchor_left = []; anchor_scale = [] };
    friction_left = [] }

(** val box_expansions :
    zero_system -> part_radii option -> box_anchoring -> (anchor_family * anchor_family) option
    list **)

let box_expansions z0 radii w =
  map0 (fun b -> expand_box z0 radii b) w.box_anchors

(** val check_anchored_box :
    zero_system -> part_radii option -> box_anchoring -> (anchor_family * anchor_family) option
    list -> region -> point -> point -> anchored_box_leaf -> bool **)

let check_anchored_box z0 radii w families0 r low high = function
| AboutAnchor (n, grain, tr') ->
  let b = nth no_box_anchor w.box_anchors n in
  (match nth None families0 n with
   | Some fams ->
     if b.reversed_anchor
     then (&&) (Z.ltb Big_int_Z.zero_big_int (fst r.lower))
            (check_about z0 radii w.mass_below w.stiffness_below b fams grain (swap_region r)
              low high tr')
     else check_about z0 radii w.stiffness_below w.mass_below b fams grain r low high tr'
   | None -> false)
| WithoutAnchor l0 ->
  (match radii with
   | Some rad -> check_exact z0 rad r low high l0
   | None -> check_whole_leaf z0 r low high l0)

(** val both_bounded : zero_system -> part_radii option -> box_anchoring -> bool **)

let both_bounded z0 radii w =
  let plain = Option.map (fun p -> p.plain_radii) radii in
  let friction = Option.map (fun p -> p.friction_radii) radii in
  (&&)
    (bounded_rows (Obj.magic size (part_plain z0).free)
      (lowered_block (part_plain z0) row_a plain) w.stiffness_below)
    ((&&)
      (bounded_rows (Obj.magic size (part_plain z0).free)
        (lowered_block (part_plain z0) row_b plain) w.mass_below)
      ((&&)
        (bounded_rows (Obj.magic size (part_friction z0).free)
          (lowered_block (part_friction z0) row_a friction) w.stiffness_below)
        (bounded_rows (Obj.magic size (part_friction z0).free)
          (lowered_block (part_friction z0) row_b friction) w.mass_below)))

(** val check_anchored_critical :
    zero_system -> part_radii option -> box_anchoring -> anchored_box_leaf tree -> point ->
    point -> bool **)

let check_anchored_critical z0 radii w tr from bound1 =
  let families0 = box_expansions z0 radii w in
  (&&) (zero_wellformed z0 Mu)
    ((&&) ((||) (nilp w.box_anchors) (both_bounded z0 radii w))
      (check_boxes (slip_number z0) (check_anchored_box z0 radii w families0) tr
        (window zero infinity) from bound1))

type presence = { presence_box : regular; presence_start : regular; presence_finish : regular }

(** val rest_row : enclosed -> enclosed -> region -> int -> regular -> int -> int -> bool **)

let rest_row p p' r k v i c =
  let p0 =
    map0 (fun j -> center (corner_pencil p p' c) (corner_end r c) i j)
      (regular_order p r (Obj.magic k))
  in
  let q =
    map0 (fun j -> radius (corner_pencil p p' c) (corner_end r c) i j)
      (regular_order p r (Obj.magic k))
  in
  Z.leb (row_slack (pred (size (regular_order p r (Obj.magic k)))) v p0 q)
    (against_right (pred (size (regular_order p r (Obj.magic k)))) v p0)

(** val positive_vector : regular -> bool **)

let positive_vector v =
  Z.ltb Big_int_Z.zero_big_int (nth Big_int_Z.zero_big_int v.regular_right 0)

(** val presence_edge : enclosed -> enclosed -> region -> int -> regular -> int list -> bool **)

let presence_edge p p' r k e cs =
  (&&) (positive_vector e)
    ((&&) (Z.ltb Big_int_Z.zero_big_int (nth Big_int_Z.zero_big_int e.regular_left 0))
      (all (fun c ->
        (&&) (rows_at p p' r (regular_order p r (Obj.magic k)) e c)
          (sign_at0 p p' r (regular_order p r (Obj.magic k)) e c)) cs))

(** val presence_inside : enclosed -> enclosed -> region -> int -> regular -> bool **)

let presence_inside p p' r k v =
  (&&) (all (rows_at p p' r (regular_order p r (Obj.magic k)) v) four_corners)
    ((&&)
      (all (fun j ->
        Z.ltb (nth Big_int_Z.zero_big_int v.regular_widths j)
          (nth Big_int_Z.zero_big_int v.regular_right (Natural.succ j)))
        (iota 0 (pred (size (regular_order p r (Obj.magic k))))))
      (all (fun i ->
        (||) (is_moving (state_of r i)) (all (rest_row p p' r k v i) four_corners)) (indices p)))

(** val check_presence_piece :
    (enclosed * enclosed) -> (enclosed * enclosed) -> (enclosed * enclosed) -> region ->
    presence -> bool **)

let check_presence_piece inside0 start finish r w =
  let k = w.presence_box.regular_pivot in
  (&&)
    ((&&) (decided (fst inside0) r)
      ((&&)
        (in_mem (Obj.magic k)
          (mem (seq_predType nat_eqType) (Obj.magic moving (fst inside0) r)))
        ((&&) (Z.ltb Big_int_Z.zero_big_int (snd r.upper))
          ((&&) (positive_vector w.presence_box)
            (presence_inside (fst inside0) (snd inside0) r k w.presence_box)))))
    ((&&)
      (presence_edge (fst start) (snd start) r k w.presence_start (0 :: ((Natural.succ
        (Natural.succ 0)) :: [])))
      ((&&)
        (presence_edge (fst finish) (snd finish) r k w.presence_finish ((Natural.succ
          0) :: ((Natural.succ (Natural.succ (Natural.succ 0))) :: [])))
        (addb w.presence_start.regular_minus w.presence_finish.regular_minus)))

type presence_piece = { piece_end : point; piece_region : region; piece_anchor : int;
                        piece_grain : Big_int_Z.big_int; piece_after : point;
                        piece_before : point; piece_witness : presence }

(** val ends_over :
    zero_system -> part_radii option -> form_bound -> form_bound -> box_anchor ->
    (anchor_family * anchor_family) -> Big_int_Z.big_int -> point -> point -> point -> point ->
    enclosed * enclosed **)

let ends_over z0 radii low_a low_b b fams grain low high lo hi =
  let a = b.plain_anchor in
  let p = local_part z0 low_a low_b a (fst fams) lo hi grain in
  let p' =
    widened radii
      (local_part z0 low_a low_b (friction_anchor a b.friction_left) (snd fams) lo hi grain)
  in
  ((mixed low p p'), (mixed high p p'))

(** val check_present :
    zero_system -> part_radii option -> form_bound -> form_bound -> box_anchor ->
    (anchor_family * anchor_family) -> Big_int_Z.big_int -> region -> point -> point -> point
    -> point -> presence -> bool **)

let check_present z0 radii low_a low_b b fams grain r low high after before v =
  let over = ends_over z0 radii low_a low_b b fams grain low high in
  let proper = proper_interval b.plain_anchor low_a low_b in
  (&&) (proper r.lower r.upper)
    ((&&) ((&&) (proper r.lower after) (proper before r.upper))
      ((&&) (Z.ltb Big_int_Z.zero_big_int grain)
        ((&&)
          (eq_op nat_eqType (Obj.magic size (fst fams).series_z)
            (Obj.magic size (snd fams).series_z))
          (check_presence_piece (over r.lower r.upper) (over r.lower after)
            (over before r.upper) (local_region r) v))))

(** val check_piece :
    zero_system -> part_radii option -> box_anchoring -> (anchor_family * anchor_family) option
    list -> point -> presence_piece -> bool **)

let check_piece z0 radii w families0 low p =
  let b = nth no_box_anchor w.box_anchors p.piece_anchor in
  let r = p.piece_region in
  (&&) ((&&) (ordered low p.piece_end) (halves_apart z0 r))
    (match nth None families0 p.piece_anchor with
     | Some fams ->
       if b.reversed_anchor
       then (&&) (Z.ltb Big_int_Z.zero_big_int (snd r.upper))
              (check_present z0 radii w.mass_below w.stiffness_below b fams p.piece_grain
                (swap_region r) low p.piece_end p.piece_after p.piece_before p.piece_witness)
       else check_present z0 radii w.stiffness_below w.mass_below b fams p.piece_grain r low
              p.piece_end p.piece_after p.piece_before p.piece_witness
     | None -> false)

(** val check_pieces :
    zero_system -> part_radii option -> box_anchoring -> (anchor_family * anchor_family) option
    list -> point -> presence_piece list -> point -> bool **)

let rec check_pieces z0 radii w families0 low pieces bound1 =
  match pieces with
  | [] -> false
  | p :: rest0 ->
    (match rest0 with
     | [] ->
       (&&) (check_piece z0 radii w families0 low p)
         (Z.leb (Big_int_Z.mult_big_int (fst bound1) (snd p.piece_end))
           (Big_int_Z.mult_big_int (fst p.piece_end) (snd bound1)))
     | _ :: _ ->
       (&&) (check_piece z0 radii w families0 low p)
         (check_pieces z0 radii w families0 p.piece_end rest0 bound1))

(** val check_presence :
    zero_system -> part_radii option -> box_anchoring -> presence_piece list -> point -> point
    -> bool **)

let check_presence z0 radii w pieces from bound1 =
  let families0 = box_expansions z0 radii w in
  (&&) (zero_wellformed z0 Mu)
    ((&&) (both_bounded z0 radii w)
      ((&&) (Z.ltb Big_int_Z.zero_big_int (snd bound1))
        (check_pieces z0 radii w families0 from pieces bound1)))

(** val one_half : zero_system -> int list -> int -> bool **)

let one_half z0 support0 j =
  (&&)
    (negb
      ((&&)
        (in_mem (Obj.magic right z0 j) (mem (seq_predType nat_eqType) (Obj.magic support0)))
        (in_mem (Obj.magic left z0 j) (mem (seq_predType nat_eqType) (Obj.magic support0)))))
    (implb (in_mem (Obj.magic gap z0 j) (mem (seq_predType nat_eqType) (Obj.magic support0)))
      ((||)
        (in_mem (Obj.magic right z0 j) (mem (seq_predType nat_eqType) (Obj.magic support0)))
        (in_mem (Obj.magic left z0 j) (mem (seq_predType nat_eqType) (Obj.magic support0)))))

(** val resting_halves : zero_system -> int list -> int list **)

let resting_halves z0 support0 =
  cat
    (map0 (fun j -> left z0 j)
      (filter (fun j ->
        (&&) (in_mem (Obj.magic gap z0 j) (mem (seq_predType nat_eqType) (Obj.magic support0)))
          (in_mem (Obj.magic right z0 j) (mem (seq_predType nat_eqType) (Obj.magic support0))))
        (iota 0 (size z0.zero_particles))))
    (map0 (fun j -> right z0 j)
      (filter (fun j ->
        (&&) (in_mem (Obj.magic gap z0 j) (mem (seq_predType nat_eqType) (Obj.magic support0)))
          (in_mem (Obj.magic left z0 j) (mem (seq_predType nat_eqType) (Obj.magic support0))))
        (iota 0 (size z0.zero_particles))))

(** val support_pencil : zero_system -> unknown -> int list -> pencil **)

let support_pencil z0 u support0 =
  let given = fun b row i ->
    if in_mem i (mem (seq_predType nat_eqType) (Obj.magic resting_halves z0 support0))
    then b
    else row (zero_pencil z0 u) i
  in
  { order = (zero_pencil z0 u).order; rows_a =
  (map0 (fun i -> Obj.magic given (((head 0 support0), Big_int_Z.unit_big_int) :: []) row_a i)
    (iota 0 (zero_pencil z0 u).order)); rows_b =
  (map0 (fun i -> Obj.magic given [] row_b i) (iota 0 (zero_pencil z0 u).order)); free =
  (zero_pencil z0 u).free }

(** val check_zero_enclosed : zero_system -> unknown -> enclosed_claim -> bool **)

let check_zero_enclosed z0 u c =
  let support0 = c.box_support in
  (&&) (zero_wellformed z0 u)
    ((&&) (zero_variables z0 support0)
      ((&&) (all (one_half z0 support0) (iota 0 (size z0.zero_particles)))
        (check_enclosed_claim (support_pencil z0 u support0) c)))

type pinned_box = { box_interval : interval; near_anchor : int; near_grain : Big_int_Z.big_int;
                    box_pinning : pinning; box_claim : enclosed_claim }

(** val known_box : zero_system -> unknown -> pinned_box -> known **)

let known_box z0 u b =
  { known_from = b.box_claim.box_from; known_to = b.box_claim.box_to; known_support =
    (positions (zero_pencil z0 u) b.box_claim.box_support); known_biactive = [] }

(** val pinned_yield : region -> pinned_box -> yield **)

let pinned_yield r b =
  { yield_region = (extended r b.box_interval); yield_from = b.box_claim.box_from; yield_to =
    b.box_claim.box_to }

(** val pinned_alone : zero_system -> unknown -> enclosed -> region -> pinned_box -> bool **)

let pinned_alone z0 u p r b =
  check_claimed p r b.box_pinning (known_box z0 u b)

(** val pinned_about :
    zero_system -> unknown -> anchoring -> anchor_family option list -> region -> pinned_box ->
    bool **)

let pinned_about z0 u w families0 r b =
  at_anchor w families0 b.near_anchor r
    (claim_at (zero_pencil z0 u) b.near_grain b.box_pinning (known_box z0 u b))

(** val check_pinned :
    zero_system -> unknown -> (region -> pinned_box -> bool) -> region -> pinned_box -> bool **)

let check_pinned z0 u alone r b =
  let r' = extended r b.box_interval in
  (&&) (ordered r.lower r.upper)
    ((&&) (reaches r b.box_interval)
      ((&&) (alone r' b)
        ((&&)
          (supports_region (enclosed_order (size (slip (zero_pencil z0 u)))) r'
            (known_box z0 u b)) (check_zero_enclosed z0 u b.box_claim))))

(** val pinned_yields : region list -> pinned_box option list -> yield list **)

let pinned_yields rs bs =
  pmap (fun rb -> Option.map (pinned_yield (fst rb)) (snd rb)) (zip rs bs)

(** val not_pinned : region list -> pinned_box option list -> region list **)

let not_pinned rs bs =
  pmap (fun rb -> match snd rb with
                  | Some _ -> None
                  | None -> Some (fst rb)) (zip rs bs)

(** val check_beside :
    zero_system -> unknown -> region list -> pinned_box option list -> (region -> pinned_box ->
    bool) -> bool **)

let check_beside z0 u rs bs alone =
  (&&) (eq_op nat_eqType (Obj.magic size rs) (Obj.magic size bs))
    (all (fun rb ->
      match snd rb with
      | Some b -> check_pinned z0 u alone (fst rb) b
      | None -> true) (zip rs bs))

(** val zero_distinct :
    zero_system -> unknown -> point -> point -> yield list -> region list -> support_leaf
    option list -> yield list option **)

let zero_distinct z0 u lo hi yields0 rs ls =
  let families0 = families_of rs ls in
  if all (halves_apart z0) (map0 fst families0)
  then (match distinct_yields (size (slip (zero_pencil z0 u))) lo hi
                (filter (fun y ->
                  negb (has (belongs (size (slip (zero_pencil z0 u))) y) families0))
                  (cat yields0 (isolated_of rs ls))) with
        | Some ys ->
          if all (halves_apart z0) (map0 (fun y -> y.yield_region) ys) then Some ys else None
        | None -> None)
  else None

(** val zero_open : zero_system -> region list -> support_leaf option list -> region list **)

let zero_open z0 rs ls =
  filter (fun r -> negb (both_halves z0 r)) (open_of rs ls)

(** val zero_undecided : cover -> point -> point -> pinned_box option list -> region list **)

let zero_undecided c lo hi bs =
  not_pinned (regions_open c lo hi) bs

(** val check_boxes_beside :
    zero_system -> unknown -> cover -> point -> point -> pinned_box option list -> bool **)

let check_boxes_beside z0 u c lo hi bs =
  match c with
  | Eliminated (w, _) ->
    check_beside z0 u (regions_open c lo hi) bs
      (pinned_alone z0 u (condensed (blocks_of (zero_pencil z0 u)) w))
  | Anchored (w, _) ->
    check_beside z0 u (regions_open c lo hi) bs
      (pinned_about z0 u w (expansions (zero_pencil z0 u) w))

(** val check_zero_complete :
    zero_system -> unknown -> solution_claim list -> cover -> point -> point -> pinned_box
    option list -> support_leaf option list -> bool **)

let check_zero_complete z0 u claims c lo hi bs ls =
  (&&) (zero_wellformed z0 u)
    ((&&) (check_cover_of (zero_pencil z0 u) claims c lo hi)
      ((&&) (check_boxes_beside z0 u c lo hi bs)
        (check_supports (zero_pencil z0 u) (zero_undecided c lo hi bs) ls)))

(** val zero_solutions :
    zero_system -> unknown -> solution_claim list -> cover -> point -> point -> pinned_box
    option list -> support_leaf option list -> yield list option **)

let zero_solutions z0 u claims c lo hi bs ls =
  zero_distinct z0 u lo hi
    (cat (regions_found (zero_pencil z0 u) claims c lo hi)
      (pinned_yields (regions_open c lo hi) bs)) (zero_undecided c lo hi bs) ls

(** val zero_families :
    cover -> point -> point -> pinned_box option list -> support_leaf option list -> family list **)

let zero_families c lo hi bs ls =
  families_of (zero_undecided c lo hi bs) ls

(** val zero_still_open :
    zero_system -> cover -> point -> point -> pinned_box option list -> support_leaf option
    list -> region list **)

let zero_still_open z0 c lo hi bs ls =
  zero_open z0 (zero_undecided c lo hi bs) ls

(** val row_at : pencil -> point -> int -> sparse_row **)

let row_at q e i =
  cat (multiple (snd e) (row_a q i)) (multiple (fst e) (row_b q i))

(** val point_pencil : pencil -> point -> pencil **)

let point_pencil q e =
  { order = q.order; rows_a = (map0 (fun i -> row_at q e i) (iota 0 q.order)); rows_b =
    (nseq q.order []); free = q.free }

(** val check_at_value :
    pencil -> point -> solution_claim list -> cover -> support_leaf option list -> bool **)

let check_at_value q e claims c ls =
  (&&) (Z.ltb Big_int_Z.zero_big_int (snd e))
    ((&&) (check_families (point_pencil q e) claims c e e ls)
      (all (fun f -> (&&) (same_point (fst f).lower e) (same_point (fst f).upper e))
        (families c e e ls)))

(** val zero_row : sparse_row -> bool **)

let zero_row row =
  all (fun c -> Big_int_Z.eq_big_int (lookup row (fst c)) Big_int_Z.zero_big_int) row

(** val reverse_pencil : pencil -> pencil **)

let reverse_pencil q =
  let constant0 = fun i -> zero_row (row_b q i) in
  { order = q.order; rows_a =
  (map0 (fun i -> if constant0 i then row_a q i else row_b q i) (iota 0 q.order)); rows_b =
  (map0 (fun i -> if constant0 i then [] else row_a q i) (iota 0 q.order)); free = q.free }

(** val check_infinity :
    pencil -> solution_claim list -> cover -> support_leaf option list -> bool **)

let check_infinity q claims c ls =
  check_at_value (reverse_pencil q) zero claims c ls

type rational0 = Big_int_Z.big_int * Big_int_Z.big_int

type rational_row = (int * rational0) list

type rational_pencil = { given_order : int; given_a : rational_row list;
                         given_b : rational_row list; given_free : int list }

(** val opposite_row : rational_row -> rational_row **)

let opposite_row row =
  map0 (fun e -> ((fst e), ((Big_int_Z.minus_big_int (fst (snd e))), (snd (snd e))))) row

(** val reflected : rational_pencil -> rational_pencil **)

let reflected q =
  { given_order = q.given_order; given_a = q.given_a; given_b = (map0 opposite_row q.given_b);
    given_free = q.given_free }

type rational_quadratic = { quadratic_order : int; quadratic_a : rational_row list;
                            quadratic_b : rational_row list; quadratic_c : rational_row list }

(** val reflected_quadratic : rational_quadratic -> rational_quadratic **)

let reflected_quadratic q =
  { quadratic_order = q.quadratic_order; quadratic_a = q.quadratic_a; quadratic_b =
    (map0 opposite_row q.quadratic_b); quadratic_c = q.quadratic_c }

(** val linearized : rational_quadratic -> rational_pencil **)

let linearized q =
  let n = q.quadratic_order in
  let numbers = iota 0 n in
  let row = fun m i -> filter (fun e -> leq (Natural.succ (fst e)) n) (nth [] m i) in
  let behind = fun r -> map0 (fun e -> ((addn n (fst e)), (snd e))) r in
  let a = row q.quadratic_a in
  let b = row q.quadratic_b in
  let c = row q.quadratic_c in
  { given_order = (addn n n); given_a =
  (cat
    (map0 (fun i ->
      cat (b i) (cat (opposite_row (c i)) (behind (cat (a i) (cat (opposite_row (b i)) (c i))))))
      numbers)
    (map0 (fun i -> (i, ((Big_int_Z.minus_big_int Big_int_Z.unit_big_int),
      Big_int_Z.unit_big_int)) :: (((addn n i), (Big_int_Z.unit_big_int,
      Big_int_Z.unit_big_int)) :: [])) numbers)); given_b =
  (cat (map0 c numbers)
    (map0 (fun i -> ((addn n i), (Big_int_Z.unit_big_int, Big_int_Z.unit_big_int)) :: [])
      numbers)); given_free = (iota n n) }

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

(** val slips : given_particle -> bool **)

let slips p =
  match p.contact_of with
  | Slipping (_, _) -> true
  | _ -> false

(** val zeroes : given_particle -> bool **)

let zeroes p =
  match p.contact_of with
  | ZeroInContact -> true
  | _ -> false

(** val in_contact : given_particle -> bool **)

let in_contact p =
  match p.contact_of with
  | NotInContact -> false
  | _ -> true

(** val sign : given_particle -> Big_int_Z.big_int **)

let sign p =
  match p.contact_of with
  | Slipping (s, _) -> s
  | _ -> Big_int_Z.zero_big_int

(** val geometric_of : given_particle -> Big_int_Z.big_int * Big_int_Z.big_int **)

let geometric_of p =
  match p.contact_of with
  | Slipping (_, g) -> g
  | _ -> (Big_int_Z.zero_big_int, Big_int_Z.unit_big_int)

(** val slipping : rational_system -> given_particle list **)

let slipping b =
  filter slips b.given_particles

(** val with_zero : rational_system -> given_particle list **)

let with_zero b =
  filter zeroes b.given_particles

(** val flat_body : rational_system -> bool **)

let flat_body b =
  all (fun p -> Big_int_Z.eq_big_int (fst (geometric_of p)) Big_int_Z.zero_big_int) (slipping b)

(** val dofs_of : given_particle list -> int list **)

let dofs_of l =
  cat (map0 (fun p -> p.first_of) l) (map0 (fun p -> p.second_of) l)

(** val held : rational_system -> int list **)

let held b =
  dofs_of (filter in_contact b.given_particles)

(** val scaled_entry : Big_int_Z.big_int -> rational0 -> Big_int_Z.big_int **)

let scaled_entry m q =
  Z.div (Big_int_Z.mult_big_int m (fst q)) (snd q)

(** val exact : Big_int_Z.big_int -> rational0 -> bool **)

let exact m q =
  (&&) (Z.ltb Big_int_Z.zero_big_int (snd q))
    (Big_int_Z.eq_big_int (Big_int_Z.mult_big_int (snd q) (scaled_entry m q))
      (Big_int_Z.mult_big_int m (fst q)))

(** val scaled_row : Big_int_Z.big_int -> rational_row -> (int * Big_int_Z.big_int) list **)

let scaled_row m row =
  map0 (fun e -> ((fst e), (scaled_entry m (snd e)))) row

(** val exact_rows : Big_int_Z.big_int -> rational_row list -> bool **)

let exact_rows m rows =
  all (all (fun e -> exact m (snd e))) rows

(** val long_normal : given_particle -> rational0 * rational0 **)

let long_normal p =
  let component0 = fun n ->
    ((Big_int_Z.mult_big_int p.into_obstacle (Big_int_Z.mult_big_int (fst p.factor_of) (fst n))),
    (Big_int_Z.mult_big_int (snd p.factor_of) (snd n)))
  in
  ((component0 (fst p.frame_normal)), (component0 (snd p.frame_normal)))

(** val scaled_planar : scales -> (rational0 * rational0) -> planar **)

let scaled_planar c e =
  ((scaled_entry c.length_scale (fst e)), (scaled_entry c.length_scale (snd e)))

(** val exact_planar : scales -> (rational0 * rational0) -> bool **)

let exact_planar c e =
  (&&) (exact c.length_scale (fst e)) (exact c.length_scale (snd e))

(** val normal_of_length : scales -> given_particle -> bool **)

let normal_of_length c p =
  let n = scaled_planar c (long_normal p) in
  Big_int_Z.eq_big_int
    (Big_int_Z.mult_big_int (inner n n)
      (Big_int_Z.mult_big_int (snd p.factor_of) (snd p.factor_of)))
    (Big_int_Z.mult_big_int (Big_int_Z.mult_big_int c.length_scale c.length_scale)
      (Big_int_Z.mult_big_int (fst p.factor_of) (fst p.factor_of)))

(** val exact_particle : scales -> given_particle -> bool **)

let exact_particle c p =
  (&&) (exact_planar c p.frame_tangent)
    ((&&) (exact_planar c (long_normal p))
      ((&&) (Z.ltb Big_int_Z.zero_big_int (fst p.factor_of))
        ((&&) (Z.ltb Big_int_Z.zero_big_int (snd p.factor_of))
          ((&&) (Z.ltb Big_int_Z.zero_big_int (snd (fst p.frame_normal)))
            ((&&) (Z.ltb Big_int_Z.zero_big_int (snd (snd p.frame_normal)))
              ((&&) (normal_of_length c p) (exact c.entry_scale (geometric_of p))))))))

(** val scaled_particle : scales -> given_particle -> slip_particle **)

let scaled_particle c p =
  { first_dof = p.first_of; second_dof = p.second_of; tangent =
    (scaled_planar c p.frame_tangent); normal = (scaled_planar c (long_normal p)); sign_of =
    (sign p); geometric_stiffness = (scaled_entry c.entry_scale (geometric_of p)) }

(** val scaled_system : scales -> rational_system -> system **)

let scaled_system c b =
  { dofs = b.degrees; stiffness =
    (map0 (fun row -> scaled_row c.entry_scale row) b.given_stiffness); mass =
    (map0 (fun row -> scaled_row c.entry_scale row) b.given_mass); free_dofs =
    (filter (fun d ->
      negb (in_mem (Obj.magic d) (mem (seq_predType nat_eqType) (Obj.magic held b))))
      (iota 0 b.degrees)); particles = (map0 (fun p -> scaled_particle c p) (slipping b));
    unit_length = c.length_scale }

(** val scaled_zero_system : scales -> rational_system -> zero_system **)

let scaled_zero_system c b =
  { without_zero = (scaled_system c b); zero_particles =
    (map0 (fun p -> scaled_particle c p) (with_zero b)) }

(** val exact_system : scales -> rational_system -> bool **)

let exact_system c b =
  (&&) (Z.ltb Big_int_Z.zero_big_int c.entry_scale)
    ((&&) (Z.ltb Big_int_Z.zero_big_int c.length_scale)
      ((&&) (exact_rows c.entry_scale b.given_stiffness)
        ((&&) (exact_rows c.entry_scale b.given_mass)
          ((&&) (uniq nat_eqType (Obj.magic dofs_of b.given_particles))
            ((&&) (all (exact_particle c) (slipping b)) (all (exact_particle c) (with_zero b)))))))

(** val scaled_pencil : scales -> rational_pencil -> pencil **)

let scaled_pencil c q =
  { order = q.given_order; rows_a = (map0 (fun row -> scaled_row c.entry_scale row) q.given_a);
    rows_b = (map0 (fun row -> scaled_row c.entry_scale row) q.given_b); free = q.given_free }

(** val exact_pencil : scales -> rational_pencil -> bool **)

let exact_pencil c q =
  (&&) (Z.ltb Big_int_Z.zero_big_int c.entry_scale)
    ((&&) (exact_rows c.entry_scale q.given_a) (exact_rows c.entry_scale q.given_b))

(** val scaled_mcp_row : scales -> rational_mcp_row -> mcp_row **)

let scaled_mcp_row c r =
  { row_m = (scaled_row c.entry_scale r.given_m); row_q =
    (scaled_entry c.entry_scale r.given_q); lower_bound = r.given_lower; upper_bound =
    r.given_upper }

(** val exact_mcp_row : scales -> rational_mcp_row -> bool **)

let exact_mcp_row c r =
  (&&) (exact c.entry_scale r.given_q) (all (fun e -> exact c.entry_scale (snd e)) r.given_m)

(** val scaled : scales -> problem -> integral option **)

let scaled c = function
| GivenPencil q -> if exact_pencil c q then Some (PencilProblem (scaled_pencil c q)) else None
| GivenSystem (b, u) ->
  if exact_system c b
  then Some
         (if nilp (with_zero b)
          then SystemProblem ((scaled_system c b), u)
          else ZeroProblem ((scaled_zero_system c b), u))
  else None
| GivenPlain rows ->
  if (&&) (Z.ltb Big_int_Z.zero_big_int c.entry_scale) (all (exact_mcp_row c) rows)
  then Some (PlainProblem (map0 (fun r -> scaled_mcp_row c r) rows))
  else None
| _ -> None

(** val signed_pencils : problem -> (rational_pencil * rational_pencil) option **)

let signed_pencils = function
| GivenEigenvalue q -> Some (q, (reflected q))
| GivenQuadratic q -> Some ((linearized q), (linearized (reflected_quadratic q)))
| _ -> None

(** val pencil_of_integral : integral -> pencil **)

let pencil_of_integral = function
| PencilProblem q0 -> q0
| SystemProblem (s, u) -> pencil_of s u
| ZeroProblem (z0, u) -> zero_pencil z0 u
| PlainProblem _ -> { order = 0; rows_a = []; rows_b = []; free = [] }

(** val complementarity : problem -> int list **)

let complementarity = function
| GivenPencil q ->
  filter (fun i ->
    negb (in_mem (Obj.magic i) (mem (seq_predType nat_eqType) (Obj.magic q.given_free))))
    (iota 0 q.given_order)
| GivenEigenvalue q ->
  filter (fun i ->
    negb (in_mem (Obj.magic i) (mem (seq_predType nat_eqType) (Obj.magic q.given_free))))
    (iota 0 q.given_order)
| GivenQuadratic q -> iota 0 q.quadratic_order
| GivenSystem (b, _) ->
  iota
    (count (fun d ->
      negb (in_mem (Obj.magic d) (mem (seq_predType nat_eqType) (Obj.magic held b))))
      (iota 0 b.degrees))
    (addn (size (slipping b))
      (muln (Natural.succ (Natural.succ (Natural.succ 0))) (size (with_zero b))))
| _ -> []

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

(** val told_apart : solution_set -> solution_set -> bool **)

let told_apart below1 above0 =
  let positive0 = fun y -> Z.ltb Big_int_Z.zero_big_int (fst y.yield_from) in
  (||) (all positive0 below1.solutions_in) (all positive0 above0.solutions_in)

(** val is_held : rational_body -> int -> bool **)

let is_held b d =
  (||) (in_mem (Obj.magic d) (mem (seq_predType nat_eqType) (Obj.magic b.held_still)))
    (has (fun l ->
      in_mem (Obj.magic d)
        (mem (seq_predType nat_eqType) (Obj.magic map0 fst l.displacements_of))) b.loads)

(** val is_apart : stated -> bool **)

let is_apart = function
| Apart -> true
| _ -> false

(** val touched : rational_body -> stated list -> int -> bool **)

let touched b states0 d =
  has (fun c ->
    (&&) (negb (is_apart (snd c)))
      (in_mem (Obj.magic d)
        (mem (seq_predType nat_eqType) (Obj.magic dofs_of ((fst c).particle_of :: [])))))
    (zip b.candidates states0)

(** val integral_wellformed : integral -> bool **)

let integral_wellformed = function
| SystemProblem (s, u) -> system_wellformed s u
| ZeroProblem (z0, u) -> zero_wellformed z0 u
| _ -> true

type system_radii = { stiffness_radii : sparse_row list; mass_radii : sparse_row list;
                      factor_shares : Big_int_Z.big_int list; factor_unit : Big_int_Z.big_int }

(** val absolute_table : system -> sparse_row list **)

let absolute_table s =
  map0 (fun row -> map0 (fun e -> ((fst e), (Big_int_Z.abs_big_int (snd e)))) row)
    (zero_table { without_zero = s; zero_particles = [] })

(** val part_direction : Big_int_Z.big_int -> Big_int_Z.big_int -> slip_particle -> planar **)

let part_direction m q p =
  direction (Big_int_Z.mult_big_int q p.sign_of) m p

(** val radius_form :
    system -> sparse_row list -> Big_int_Z.big_int -> Big_int_Z.big_int -> int -> sparse_row **)

let radius_form s rows m q i =
  if leq (Natural.succ i) (free_number s)
  then nth [] rows (nth 0 s.free_dofs i)
  else let p = particle s (subn i (free_number s)) in
       let e = part_direction m q p in
       at_both (nth [] rows) p ((Big_int_Z.abs_big_int (fst e)),
         (Big_int_Z.abs_big_int (snd e)))

(** val radius_rows :
    system -> sparse_row list -> Big_int_Z.big_int -> Big_int_Z.big_int -> sparse_row list **)

let radius_rows s rows m q =
  map0 (fun i -> table_row (absolute_table s) (radius_form s rows m q i))
    (iota 0 (part_plain { without_zero = s; zero_particles = [] }).order)

(** val radii_of_parts : system -> system_radii -> part_radii **)

let radii_of_parts s rad =
  { plain_radii =
    ((radius_rows s rad.stiffness_radii Big_int_Z.zero_big_int Big_int_Z.unit_big_int),
    (radius_rows s rad.mass_radii Big_int_Z.zero_big_int Big_int_Z.unit_big_int));
    friction_radii =
    ((radius_rows s rad.stiffness_radii Big_int_Z.unit_big_int Big_int_Z.zero_big_int),
    (radius_rows s rad.mass_radii Big_int_Z.unit_big_int Big_int_Z.zero_big_int));
    friction_shares = rad.factor_shares; share_unit = rad.factor_unit }

(** val radii_wellformed : system -> system_radii -> bool **)

let radii_wellformed s rad =
  (&&) (Z.ltb Big_int_Z.zero_big_int rad.factor_unit)
    ((&&) (columns_in_range s rad.stiffness_radii) (columns_in_range s rad.mass_radii))

(** val check_members_absent :
    system -> system_radii -> box_anchoring -> anchored_box_leaf tree -> point -> point -> bool **)

let check_members_absent s rad w tr from bound1 =
  (&&) (radii_wellformed s rad)
    ((&&)
      (both_bounded { without_zero = s; zero_particles = [] } (Some (radii_of_parts s rad)) w)
      (check_anchored_critical { without_zero = s; zero_particles = [] } (Some
        (radii_of_parts s rad)) w tr from bound1))

(** val check_members_present :
    system -> system_radii -> box_anchoring -> presence_piece list -> point -> point -> bool **)

let check_members_present s rad w pieces from bound1 =
  (&&) (radii_wellformed s rad)
    (check_presence { without_zero = s; zero_particles = [] } (Some (radii_of_parts s rad)) w
      pieces from bound1)

(** val scaled_radii :
    scales -> rational_radii -> Big_int_Z.big_int list -> Big_int_Z.big_int -> system_radii **)

let scaled_radii c radii shares unit0 =
  { stiffness_radii =
    (map0 (fun row -> scaled_row c.entry_scale row) radii.radii_of_stiffness); mass_radii =
    (map0 (fun row -> scaled_row c.entry_scale row) radii.radii_of_mass); factor_shares =
    shares; factor_unit = unit0 }

(** val range_in_share :
    Big_int_Z.big_int -> rational0 -> (rational0 * rational0) -> Big_int_Z.big_int -> bool **)

let range_in_share unit0 f range share =
  (&&) (Z.ltb Big_int_Z.zero_big_int (snd (fst range)))
    ((&&) (Z.ltb Big_int_Z.zero_big_int (snd (snd range)))
      ((&&)
        (Z.leb
          (Big_int_Z.mult_big_int (Big_int_Z.mult_big_int (fst f) (snd (fst range)))
            (Big_int_Z.sub_big_int unit0 share))
          (Big_int_Z.mult_big_int (Big_int_Z.mult_big_int (fst (fst range)) (snd f)) unit0))
        (Z.leb
          (Big_int_Z.mult_big_int (Big_int_Z.mult_big_int (fst (snd range)) (snd f)) unit0)
          (Big_int_Z.mult_big_int (Big_int_Z.mult_big_int (fst f) (snd (snd range)))
            (Big_int_Z.add_big_int unit0 share)))))

(** val exact_radii :
    scales -> rational_system -> rational_radii -> Big_int_Z.big_int list -> Big_int_Z.big_int
    -> bool **)

let exact_radii c b radii shares unit0 =
  (&&) (exact_system c b)
    ((&&) (nilp (with_zero b))
      ((&&) (exact_rows c.entry_scale radii.radii_of_stiffness)
        ((&&) (exact_rows c.entry_scale radii.radii_of_mass)
          ((&&) (Z.ltb Big_int_Z.zero_big_int unit0)
            (all (fun j ->
              range_in_share unit0
                (nth { first_of = 0; second_of = 0; contact_of = NotInContact; frame_tangent =
                  ((Big_int_Z.zero_big_int, Big_int_Z.unit_big_int), (Big_int_Z.zero_big_int,
                  Big_int_Z.unit_big_int)); frame_normal = ((Big_int_Z.zero_big_int,
                  Big_int_Z.unit_big_int), (Big_int_Z.zero_big_int, Big_int_Z.unit_big_int));
                  into_obstacle = Big_int_Z.zero_big_int; factor_of = (Big_int_Z.zero_big_int,
                  Big_int_Z.unit_big_int) } (slipping b) j).factor_of
                (nth ((Big_int_Z.zero_big_int, Big_int_Z.unit_big_int),
                  (Big_int_Z.zero_big_int, Big_int_Z.unit_big_int)) radii.factor_ranges j)
                (nth Big_int_Z.zero_big_int shares j)) (iota 0 (size (slipping b))))))))

(** val check_radii_absent :
    scales -> rational_system -> rational_radii -> Big_int_Z.big_int list -> Big_int_Z.big_int
    -> box_anchoring -> anchored_box_leaf tree -> point -> point -> bool **)

let check_radii_absent c b radii shares unit0 w tr from bound1 =
  (&&) (exact_radii c b radii shares unit0)
    (check_members_absent (scaled_system c b) (scaled_radii c radii shares unit0) w tr from
      bound1)

(** val check_radii_present :
    scales -> rational_system -> rational_radii -> Big_int_Z.big_int list -> Big_int_Z.big_int
    -> box_anchoring -> presence_piece list -> point -> point -> bool **)

let check_radii_present c b radii shares unit0 w pieces from bound1 =
  (&&) (exact_radii c b radii shares unit0)
    (check_members_present (scaled_system c b) (scaled_radii c radii shares unit0) w pieces
      from bound1)

type equilibrium_evidence =
| ExactAt of Big_int_Z.big_int list
| BoxAround of Big_int_Z.big_int list * matrix * Big_int_Z.big_int

(** val dominated_row :
    polynomial list -> Big_int_Z.big_int list -> Big_int_Z.big_int -> int -> sparse_row -> bool **)

let dominated_row y v w i row =
  let g = combine_row y row in
  (&&) (Z.ltb Big_int_Z.zero_big_int (margin g i))
    (Z.leb (Big_int_Z.abs_big_int (sparse_dot row v)) (Big_int_Z.mult_big_int (margin g i) w))

(** val check_rows :
    int -> sparse_row list -> sparse_row list -> equilibrium_evidence -> bool **)

let check_rows n eqs ineqs = function
| ExactAt v ->
  (&&) (Z.ltb Big_int_Z.zero_big_int (nth Big_int_Z.zero_big_int v n))
    ((&&) (all (fun row -> Big_int_Z.eq_big_int (sparse_dot row v) Big_int_Z.zero_big_int) eqs)
      (all (fun row -> Z.ltb Big_int_Z.zero_big_int (sparse_dot row v)) ineqs))
| BoxAround (v, y, w0) ->
  let eps = map0 (fun row -> Big_int_Z.mult_big_int (norm1 row) w0) y in
  (&&) (Z.ltb Big_int_Z.zero_big_int (nth Big_int_Z.zero_big_int v n))
    ((&&) (leq (size y) n)
      ((&&) (Z.leb Big_int_Z.zero_big_int w0)
        ((&&) (all_from (dominated_row y v w0) 0 eqs)
          (all (fun row -> Z.ltb (absolute_dot row eps) (sparse_dot row v)) ineqs))))

(** val times_rational : rational0 -> rational0 -> rational0 **)

let times_rational a b =
  ((Big_int_Z.mult_big_int (fst a) (fst b)), (Big_int_Z.mult_big_int (snd a) (snd b)))

(** val scaled_by : rational0 -> rational_row -> rational_row **)

let scaled_by a row =
  map0 (fun e -> ((fst e), (times_rational a (snd e)))) row

(** val negated : rational_row -> rational_row **)

let negated =
  scaled_by ((Big_int_Z.minus_big_int Big_int_Z.unit_big_int), Big_int_Z.unit_big_int)

(** val constant : rational_body -> rational0 -> rational_row **)

let constant b q =
  (b.body_degrees, q) :: []

(** val applied_row :
    rational_body -> rational0 list -> (load -> rational_row) -> int -> rational_row **)

let applied_row b amounts part d =
  flatten
    (map0 (fun la ->
      map0 (fun e -> (b.body_degrees, (times_rational (snd la) (snd e))))
        (filter (fun e -> eq_op nat_eqType (fst (Obj.magic e)) (Obj.magic d)) (part (fst la))))
      (zip b.loads amounts))

(** val displacement_row : int -> rational_row **)

let displacement_row d =
  (d, (Big_int_Z.unit_big_int, Big_int_Z.unit_big_int)) :: []

(** val reaction_row : rational_body -> rational0 list -> int -> (int * rational0) list **)

let reaction_row b amounts d =
  cat (nth [] b.body_stiffness d) (negated (applied_row b amounts (fun l -> l.forces_of) d))

(** val tangential_row : given_particle -> (int -> rational_row) -> (int * rational0) list **)

let tangential_row p f =
  cat (scaled_by (fst p.frame_tangent) (f p.first_of))
    (scaled_by (snd p.frame_tangent) (f p.second_of))

(** val normal_row : given_particle -> (int -> rational_row) -> rational_row **)

let normal_row p f =
  scaled_by (p.into_obstacle, Big_int_Z.unit_big_int)
    (cat (scaled_by (fst p.frame_normal) (f p.first_of))
      (scaled_by (snd p.frame_normal) (f p.second_of)))

(** val pressure_row : rational_body -> rational0 list -> given_particle -> rational_row **)

let pressure_row b amounts p =
  negated (normal_row p (reaction_row b amounts))

(** val bound_row :
    rational_body -> rational0 -> rational0 list -> given_particle -> rational_row **)

let bound_row b mu amounts p =
  scaled_by mu (scaled_by p.factor_of (pressure_row b amounts p))

(** val equations_at :
    rational_body -> rational0 list -> stated list -> int -> (int * rational0) list list **)

let equations_at b amounts states0 d =
  if is_held b d
  then (cat (displacement_row d)
         (negated (applied_row b amounts (fun l -> l.displacements_of) d))) :: []
  else if touched b states0 d then [] else (reaction_row b amounts d) :: []

(** val state_equations :
    rational_body -> rational0 -> rational0 list -> candidate -> stated -> (int * rational0)
    list list **)

let state_equations b mu amounts c s =
  let p = c.particle_of in
  let touching = cat (normal_row p displacement_row) (negated (constant b c.gap_of)) in
  let tangential = tangential_row p (reaction_row b amounts) in
  (match s with
   | Apart -> []
   | SticksAt place0 ->
     touching :: ((cat (tangential_row p displacement_row) (negated (constant b place0))) :: [])
   | SlipsWith sign0 ->
     touching :: ((cat (scaled_by (sign0, Big_int_Z.unit_big_int) tangential)
                    (negated (bound_row b mu amounts p))) :: [])
   | WithoutReaction ->
     touching :: ((normal_row p (reaction_row b amounts)) :: (tangential :: [])))

(** val state_inequalities :
    rational_body -> rational0 -> rational0 list -> candidate -> stated -> (int * rational0)
    list list **)

let state_inequalities b mu amounts c s =
  let p = c.particle_of in
  let tangential = tangential_row p (reaction_row b amounts) in
  (match s with
   | Apart -> (cat (constant b c.gap_of) (negated (normal_row p displacement_row))) :: []
   | SticksAt _ ->
     (pressure_row b amounts p) :: ((cat (bound_row b mu amounts p) (negated tangential)) :: (
       (cat (bound_row b mu amounts p) tangential) :: []))
   | SlipsWith _ -> (pressure_row b amounts p) :: []
   | WithoutReaction -> [])

(** val of_candidates :
    rational_body -> stated list -> (candidate -> stated -> rational_row list) -> rational_row
    list **)

let of_candidates b states0 rows =
  flatten (map0 (fun c -> rows (fst c) (snd c)) (zip b.candidates states0))

(** val equations :
    rational_body -> rational0 -> rational0 list -> stated list -> (int * rational0) list list **)

let equations b mu amounts states0 =
  cat (flatten (map0 (fun d -> equations_at b amounts states0 d) (iota 0 b.body_degrees)))
    (of_candidates b states0 (state_equations b mu amounts))

(** val inequalities :
    rational_body -> rational0 -> rational0 list -> stated list -> rational_row list **)

let inequalities b mu amounts states0 =
  of_candidates b states0 (state_inequalities b mu amounts)

(** val positive_rational : rational0 -> bool **)

let positive_rational q =
  (&&) (Z.ltb Big_int_Z.zero_big_int (fst q)) (Z.ltb Big_int_Z.zero_big_int (snd q))

(** val lawful : (candidate * stated) -> bool **)

let lawful c =
  (&&) (positive_rational (fst c).particle_of.factor_of)
    (match snd c with
     | SlipsWith sign0 ->
       (||) (Big_int_Z.eq_big_int sign0 Big_int_Z.unit_big_int)
         (Big_int_Z.eq_big_int sign0 (Big_int_Z.minus_big_int Big_int_Z.unit_big_int))
     | _ -> true)

(** val well_stated : rational_body -> rational0 -> rational0 list -> stated list -> bool **)

let well_stated b mu amounts states0 =
  (&&) (positive_rational mu)
    ((&&) (eq_op nat_eqType (Obj.magic size amounts) (Obj.magic size b.loads))
      ((&&) (eq_op nat_eqType (Obj.magic size states0) (Obj.magic size b.candidates))
        ((&&) (all (all (fun e -> leq (Natural.succ (fst e)) b.body_degrees)) b.body_stiffness)
          (all lawful (zip b.candidates states0)))))

(** val check_equilibrium :
    rational_body -> rational0 -> rational0 list -> stated list -> Big_int_Z.big_int ->
    equilibrium_evidence -> bool **)

let check_equilibrium b mu amounts states0 m w =
  let eqs = equations b mu amounts states0 in
  let ineqs = inequalities b mu amounts states0 in
  (&&) (well_stated b mu amounts states0)
    ((&&) (Z.ltb Big_int_Z.zero_big_int m)
      ((&&) (exact_rows m eqs)
        ((&&) (exact_rows m ineqs)
          (check_rows b.body_degrees (map0 (fun row -> scaled_row m row) eqs)
            (map0 (fun row -> scaled_row m row) ineqs) w))))

(** val check_rates :
    system -> (Big_int_Z.big_int * Big_int_Z.big_int) -> point -> elimination -> signed_ends ->
    bool **)

let check_rates s lo hi w f =
  let q = pencil_of s Mu in
  let d = blocks_of q in
  let p = condensed d w in
  (&&) (system_wellformed s Mu)
    ((&&) (wellformed q)
      ((&&) (free_rows_constant q)
        ((&&) (check_elimination d w)
          ((&&) (Z.ltb Big_int_Z.zero_big_int (fst lo))
            ((&&) (Z.ltb Big_int_Z.zero_big_int (snd lo))
              ((&&) (ordered lo hi) (signed_between p lo hi f)))))))

(** val check_given_rates :
    scales -> rational_system -> (Big_int_Z.big_int * Big_int_Z.big_int) -> point ->
    elimination -> signed_ends -> bool **)

let check_given_rates c b lo hi w f =
  (&&) (exact_system c b)
    ((&&) (nilp (with_zero b)) (check_rates (scaled_system c b) lo hi w f))

type stable_end = { end_form : matrix; end_slope : Big_int_Z.big_int list;
                    end_unit : Big_int_Z.big_int; end_times : Big_int_Z.big_int;
                    end_gram : Big_int_Z.big_int; end_rows : late_row list }

type stability = { gain : matrix; gain_unit : Big_int_Z.big_int; mass_form : form_bound;
                   turn : point; wide : point; root : point }

(** val mu_pencil : system -> pencil **)

let mu_pencil s =
  pencil_of s Mu

(** val mass_pencil : system -> pencil **)

let mass_pencil s =
  pencil_of s (Lambda2 (Big_int_Z.zero_big_int, Big_int_Z.unit_big_int))

(** val friction_pencil : system -> pencil **)

let friction_pencil s =
  pencil_of s (Lambda2 (Big_int_Z.unit_big_int, Big_int_Z.zero_big_int))

(** val length_of : system -> int -> Big_int_Z.big_int **)

let length_of s i =
  if leq (Natural.succ i) (free_number s) then s.unit_length else Big_int_Z.unit_big_int

(** val symmetric_form : system -> sparse_row list -> sparse_row list **)

let symmetric_form s rows =
  map_from (fun i row -> times_row (length_of s i) row) 0 rows

(** val k_rows : system -> sparse_row list **)

let k_rows s =
  symmetric_form s (mu_pencil s).rows_a

(** val m_rows : system -> sparse_row list **)

let m_rows s =
  symmetric_form s (mass_pencil s).rows_b

(** val corrected_row :
    stability -> sparse_row list -> sparse_row -> Big_int_Z.big_int list -> sparse_row **)

let corrected_row d free0 row g =
  cat (times_row d.gain_unit row)
    (flatten
      (map0 (fun e -> times_row (Big_int_Z.minus_big_int (fst e)) (snd e)) (zip g free0)))

(** val corrected_at :
    system -> stability -> sparse_row list -> sparse_row list -> int -> sparse_row **)

let corrected_at s d free0 friction j =
  corrected_row d (take (free_number s) free0) (nth [] friction (addn (free_number s) j))
    (row_of d.gain j)

(** val sum_abs : sparse_row -> Big_int_Z.big_int **)

let sum_abs row =
  norm1 (spread row)

(** val sumZ_of : ('a1 -> Big_int_Z.big_int) -> 'a1 list -> Big_int_Z.big_int **)

let sumZ_of f l =
  foldr (fun x sum0 -> Big_int_Z.add_big_int (f x) sum0) Big_int_Z.zero_big_int l

(** val turned_in :
    system -> stability -> sparse_row list -> sparse_row list -> Big_int_Z.big_int list **)

let turned_in s d free0 friction =
  map0 (fun j -> sum_abs (corrected_at s d free0 friction j)) (iota 0 (size s.particles))

(** val kappa_in :
    system -> stability -> sparse_row list -> sparse_row list -> point -> Big_int_Z.big_int **)

let kappa_in s d free0 friction hi =
  Big_int_Z.add_big_int
    (Big_int_Z.mult_big_int (Big_int_Z.mult_big_int d.gain_unit (snd hi))
      (sumZ_of sum_abs free0))
    (Big_int_Z.mult_big_int (fst hi)
      (sumZ_of (fun j -> sum_abs (corrected_at s d free0 friction j))
        (iota 0 (size s.particles))))

(** val form_vector : system -> elimination -> stability -> int -> Big_int_Z.big_int list **)

let form_vector s w d j =
  let g = row_of d.gain j in
  map_from (fun k x ->
    Big_int_Z.sub_big_int (Big_int_Z.mult_big_int d.gain_unit x)
      (Big_int_Z.mult_big_int (Big_int_Z.mult_big_int w.unit_of s.unit_length)
        (nth Big_int_Z.zero_big_int g k))) 0
    (map0 (fun k -> nth Big_int_Z.zero_big_int (row_of w.left_vb j) k) (iota 0 (free_number s)))

(** val form_rest : elimination -> stability -> blocks -> int -> Big_int_Z.big_int list **)

let form_rest w d d0 j =
  map0 (fun x -> Big_int_Z.mult_big_int d.gain_unit x)
    (residual_column d0 w d0.sf_b w.left_vb j)

(** val form_size : system -> elimination -> stability -> blocks -> int -> Big_int_Z.big_int **)

let form_size s w d d0 j =
  let v = form_vector s w d j in
  let l = form_rest w d d0 j in
  let fv = map0 (fun row -> sparse_dot row v) d0.ff in
  Big_int_Z.add_big_int
    (Big_int_Z.mult_big_int w.bound_d
      (Big_int_Z.add_big_int (dot v fv)
        (Big_int_Z.mult_big_int (Big_int_Z.mult_int_big_int 2 Big_int_Z.unit_big_int) (dot v l))))
    (Big_int_Z.mult_big_int w.bound_c (dot l l))

(** val width_bound : system -> elimination -> blocks -> Big_int_Z.big_int **)

let width_bound s w d =
  sumZ_of (fun j ->
    Big_int_Z.add_big_int (Big_int_Z.mult_big_int w.bound_d (norm1 (row_of w.right_w j)))
      (Big_int_Z.mult_big_int w.bound_c (norm1 (residual_column d w d.fs w.right_w j))))
    (iota 0 (size s.particles))

(** val check_turn :
    system -> stability -> sparse_row list -> sparse_row list -> Big_int_Z.big_int list ->
    point -> bool **)

let check_turn s d free0 friction e hi =
  (&&) (Z.ltb Big_int_Z.zero_big_int (snd d.turn))
    ((&&) (Z.leb Big_int_Z.zero_big_int (fst d.turn))
      ((&&)
        (Z.leb
          (Big_int_Z.mult_big_int
            (Big_int_Z.mult_big_int
              (Big_int_Z.mult_big_int (Big_int_Z.mult_int_big_int 2 Big_int_Z.unit_big_int)
                (snd d.turn)) d.mass_form.bound_times) (kappa_in s d free0 friction hi))
          (Big_int_Z.mult_big_int
            (Big_int_Z.mult_big_int (Big_int_Z.mult_big_int (fst d.turn) d.mass_form.bound_at)
              d.gain_unit) (snd hi)))
        (Z.leb
          (Big_int_Z.mult_big_int
            (Big_int_Z.mult_big_int
              (Big_int_Z.mult_big_int (Big_int_Z.mult_int_big_int 2 Big_int_Z.unit_big_int)
                (fst hi)) d.mass_form.bound_times) (sumZ_of (fun x -> x) e))
          (Big_int_Z.mult_big_int (Big_int_Z.mult_big_int d.mass_form.bound_at (snd hi))
            d.gain_unit))))

(** val check_wide : system -> elimination -> stability -> blocks -> bool **)

let check_wide s w d d0 =
  (&&) (Z.ltb Big_int_Z.zero_big_int (snd d.wide))
    ((&&) (Z.leb Big_int_Z.zero_big_int (fst d.wide))
      (Z.leb (Big_int_Z.mult_big_int (snd d.wide) (width_bound s w d0))
        (Big_int_Z.mult_big_int (fst d.wide) (Big_int_Z.mult_big_int w.unit_of w.bound_d))))

(** val check_root0 : Big_int_Z.big_int -> system -> elimination -> stability -> bool **)

let check_root0 c s w d =
  (&&) (Z.ltb Big_int_Z.zero_big_int (snd d.root))
    ((&&) (Z.leb Big_int_Z.zero_big_int (fst d.root))
      ((||) (nilp s.free_dofs)
        (Z.leb
          (Big_int_Z.mult_big_int (Big_int_Z.mult_big_int (snd d.root) (snd d.root))
            (Big_int_Z.mult_big_int w.bound_c (Big_int_Z.mult_big_int c s.unit_length)))
          (Big_int_Z.mult_big_int (Big_int_Z.mult_big_int (fst d.root) (fst d.root)) w.bound_d))))

(** val check_shapes :
    system -> stability -> (int * Big_int_Z.big_int) list list -> (int * Big_int_Z.big_int)
    list list -> (int * Big_int_Z.big_int) list list -> (int * Big_int_Z.big_int) list list ->
    bool **)

let check_shapes s d free0 friction mass0 mass_friction =
  let n = addn (free_number s) (size s.particles) in
  let small0 = fun rows -> all (all (fun e -> leq (Natural.succ (fst e)) n)) rows in
  (&&) (Z.ltb Big_int_Z.zero_big_int d.gain_unit)
    ((&&)
      (all (fun j -> leq (size (row_of d.gain j)) (free_number s)) (iota 0 (size s.particles)))
      ((&&) ((&&) (small0 free0) (small0 mass0))
        ((&&)
          (small0
            (map0 (fun j -> nth [] friction (addn (free_number s) j))
              (iota 0 (size s.particles))))
          ((&&)
            (small0
              (map0 (fun j -> nth [] mass_friction (addn (free_number s) j))
                (iota 0 (size s.particles))))
            ((&&) (symmetric_rows_sparse free0) (symmetric_rows_sparse mass0))))))

(** val drag_times :
    stability -> Big_int_Z.big_int list -> point -> int -> Big_int_Z.big_int **)

let drag_times d turned0 e i =
  Big_int_Z.mult_big_int
    (Big_int_Z.mult_big_int (fst e) (nth Big_int_Z.zero_big_int turned0 i)) (fst d.turn)

(** val below0 :
    Big_int_Z.big_int -> system -> elimination -> stability -> enclosed -> Big_int_Z.big_int
    list -> point -> stable_end -> int -> int -> bool **)

let below0 c s w d p turned0 e f i j =
  let units =
    Big_int_Z.mult_big_int (Big_int_Z.mult_big_int d.gain_unit (snd d.turn)) (snd d.wide)
  in
  Z.leb
    (Big_int_Z.mult_big_int
      (Big_int_Z.mult_big_int (nth Big_int_Z.zero_big_int w.row_scale i)
        (Big_int_Z.mult_big_int w.unit_of w.unit_of))
      (Big_int_Z.add_big_int
        (Big_int_Z.mult_big_int
          (Big_int_Z.mult_big_int
            (Big_int_Z.mult_big_int
              (Big_int_Z.mult_big_int c (Big_int_Z.mult_big_int s.unit_length s.unit_length))
              (snd e)) units) (entry f.end_form i j))
        (Big_int_Z.mult_big_int (Big_int_Z.mult_big_int f.end_unit (drag_times d turned0 e i))
          (Big_int_Z.add_big_int (snd d.wide) (fst d.wide)))))
    (Big_int_Z.mult_big_int (Big_int_Z.sub_big_int (center p e i j) (radius p e i j))
      (Big_int_Z.mult_big_int f.end_unit units))

(** val steep :
    Big_int_Z.big_int -> system -> elimination -> stability -> Big_int_Z.big_int list ->
    Big_int_Z.big_int list -> point -> stable_end -> int -> bool **)

let steep c s w d turned0 sizes e f i =
  let units =
    Big_int_Z.mult_big_int
      (Big_int_Z.mult_big_int
        (Big_int_Z.mult_big_int (Big_int_Z.mult_big_int (snd e) d.gain_unit) (snd d.turn))
        (snd d.root))
      (Big_int_Z.mult_big_int c (Big_int_Z.mult_big_int s.unit_length s.unit_length))
  in
  let rest0 =
    Big_int_Z.sub_big_int
      (Big_int_Z.mult_big_int (nth Big_int_Z.zero_big_int f.end_slope i) units)
      (Big_int_Z.mult_big_int (Big_int_Z.mult_big_int f.end_unit (drag_times d turned0 e i))
        (fst d.root))
  in
  let u = Big_int_Z.mult_big_int d.gain_unit w.unit_of in
  (&&) (Z.leb Big_int_Z.zero_big_int rest0)
    (Z.leb
      (Big_int_Z.mult_big_int
        (Big_int_Z.mult_big_int (Big_int_Z.mult_big_int (fst e) (fst e))
          (nth Big_int_Z.zero_big_int sizes i))
        (Big_int_Z.mult_big_int (Big_int_Z.mult_big_int f.end_unit units)
          (Big_int_Z.mult_big_int f.end_unit units)))
      (Big_int_Z.mult_big_int
        (Big_int_Z.mult_big_int (Big_int_Z.mult_big_int (snd e) (snd e))
          (Big_int_Z.mult_big_int rest0 rest0))
        (Big_int_Z.mult_big_int
          (Big_int_Z.mult_big_int
            (Big_int_Z.mult_big_int
              (Big_int_Z.mult_big_int c (Big_int_Z.mult_big_int s.unit_length s.unit_length))
              s.unit_length) w.bound_d) (Big_int_Z.mult_big_int u u))))

(** val form_entry : stable_end -> int -> int -> Big_int_Z.big_int **)

let form_entry f i j =
  Big_int_Z.mult_big_int f.end_times
    (Big_int_Z.sub_big_int
      (Big_int_Z.mult_big_int
        (Big_int_Z.mult_big_int (Big_int_Z.mult_int_big_int 2 (Big_int_Z.mult_int_big_int 2
          Big_int_Z.unit_big_int)) f.end_unit) (entry f.end_form i j))
      (Big_int_Z.mult_big_int (nth Big_int_Z.zero_big_int f.end_slope i)
        (nth Big_int_Z.zero_big_int f.end_slope j)))

(** val check_end0 :
    Big_int_Z.big_int -> system -> elimination -> stability -> enclosed -> Big_int_Z.big_int
    list -> Big_int_Z.big_int list -> point -> stable_end -> bool **)

let check_end0 c s w d p turned0 sizes e f =
  (&&) (Z.ltb Big_int_Z.zero_big_int f.end_unit)
    ((&&) (Z.ltb Big_int_Z.zero_big_int f.end_times)
      ((&&) (Z.leb Big_int_Z.zero_big_int f.end_gram)
        ((&&)
          (all (fun i ->
            all (fun j -> Big_int_Z.eq_big_int (entry f.end_form i j) (entry f.end_form j i))
              (iota 0 (size s.particles))) (iota 0 (size s.particles)))
          ((&&)
            (all (fun i ->
              Z.leb Big_int_Z.zero_big_int (nth Big_int_Z.zero_big_int f.end_slope i))
              (iota 0 (size s.particles)))
            ((&&)
              (all (fun i -> all (below0 c s w d p turned0 e f i) (iota 0 (size s.particles)))
                (iota 0 (size s.particles)))
              ((&&) (all (steep c s w d turned0 sizes e f) (iota 0 (size s.particles)))
                ((&&)
                  (eq_op nat_eqType (Obj.magic size f.end_rows) (Obj.magic size s.particles))
                  (covered (form_entry f) (fun a b ->
                    Big_int_Z.mult_big_int f.end_gram (late_dot a b)) true
                    (zip (iota 0 (size s.particles)) f.end_rows)))))))))

(** val check_stable :
    Big_int_Z.big_int -> system -> elimination -> stability -> point -> point -> stable_end ->
    stable_end -> bool **)

let check_stable c s w d lo hi low high =
  let q = mu_pencil s in
  let d0 = blocks_of q in
  let p = condensed d0 w in
  let k = symmetric_form s q.rows_a in
  let m = m_rows s in
  let mass_friction = (friction_pencil s).rows_b in
  let turned0 = turned_in s d m mass_friction in
  let sizes = map0 (fun j -> form_size s w d d0 j) (iota 0 (size s.particles)) in
  let n = addn (free_number s) (size s.particles) in
  (&&) (system_wellformed s Mu)
    ((&&) (wellformed q)
      ((&&) (free_rows_constant q)
        ((&&) (check_elimination d0 w)
          ((&&) (ordered lo hi)
            ((&&) (Z.ltb Big_int_Z.zero_big_int (snd hi))
              ((&&) (check_shapes s d k q.rows_b m mass_friction)
                ((&&)
                  ((&&) (Z.ltb Big_int_Z.zero_big_int d.mass_form.bound_at)
                    (bounded_rows (Obj.magic n) m d.mass_form))
                  ((&&) (check_turn s d k q.rows_b turned0 hi)
                    ((&&) (check_wide s w d d0)
                      ((&&) (check_root0 c s w d)
                        ((&&) (check_end0 c s w d p turned0 sizes lo low)
                          (check_end0 c s w d p turned0 sizes hi high))))))))))))

(** val check_given_stable :
    scales -> rational_system -> elimination -> stability -> point -> point -> stable_end ->
    stable_end -> bool **)

let check_given_stable c b w d lo hi low high =
  (&&) (exact_system c b)
    ((&&) (nilp (with_zero b))
      (check_stable c.entry_scale (scaled_system c b) w d lo hi low high))

(** val zero_yield : yield -> bool **)

let zero_yield y =
  (&&) (Z.ltb Big_int_Z.zero_big_int (snd y.yield_to))
    (Z.leb (fst y.yield_to) Big_int_Z.zero_big_int)

(** val zero_family : family -> bool **)

let zero_family f =
  match (snd f).held_place with
  | PointAt v ->
    (&&) (Z.ltb Big_int_Z.zero_big_int v.value_den) (Z.leb v.value_to Big_int_Z.zero_big_int)
  | _ -> false

(** val nonzero_values : solution_set -> solution_set **)

let nonzero_values c =
  { solutions_in = (filter (fun y -> negb (zero_yield y)) c.solutions_in); families_of_set =
    (filter (fun f -> negb (zero_family f)) c.families_of_set); open_regions = c.open_regions }

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

(** val asserted_of : solution_claim -> asserted **)

let asserted_of k =
  { asserted_from = (claimed_from k); asserted_to = (claimed_to k); asserted_support =
    (claimed_support k); asserted_biactive = (claimed_biactive k) }

(** val asserted_motion : zero_claim -> asserted **)

let asserted_motion c =
  let k = c.lifted_part.motion_claim in
  { asserted_from = (k.claim_from, k.claim_denominator); asserted_to = (k.claim_to,
  k.claim_denominator); asserted_support = k.support; asserted_biactive = k.biactive }

(** val claim_answer : integral -> pencil -> claim_evidence -> asserted option **)

let claim_answer p q c =
  match p with
  | PencilProblem _ ->
    (match c with
     | OfPencil k -> if check_solution_claim q k then Some (asserted_of k) else None
     | _ -> None)
  | SystemProblem (s, u) ->
    (match c with
     | OfPencil k -> if check_solution_claim q k then Some (asserted_of k) else None
     | OfMotion c0 ->
       if check_zero { without_zero = s; zero_particles = [] } u c0
       then Some (asserted_motion c0)
       else None
     | OfZeroBox _ -> None)
  | ZeroProblem (z0, u) ->
    (match c with
     | OfPencil _ -> None
     | OfMotion c0 -> if check_zero z0 u c0 then Some (asserted_motion c0) else None
     | OfZeroBox c0 ->
       if check_zero_enclosed z0 u c0
       then Some { asserted_from = c0.box_from; asserted_to = c0.box_to; asserted_support =
              c0.box_support; asserted_biactive = (resting_halves z0 c0.box_support) }
       else None)
  | PlainProblem _ -> None

(** val in_window : point -> point -> asserted -> bool **)

let in_window lo hi a =
  within (a.asserted_from, a.asserted_to) (lo, hi)

(** val all_asserted :
    integral -> pencil -> point -> point -> int -> claim_evidence list -> (asserted list, int)
    sum **)

let rec all_asserted p q lo hi k = function
| [] -> Inl []
| c :: l' ->
  (match claim_answer p q c with
   | Some a ->
     if in_window lo hi a
     then (match all_asserted p q lo hi (Natural.succ k) l' with
           | Inl said -> Inl (a :: said)
           | Inr refused -> Inr refused)
     else Inr k
   | None -> Inr k)

(** val claims_answer :
    integral -> pencil -> point -> point -> claim_evidence list -> answered **)

let claims_answer p q lo hi l =
  match all_asserted p q lo hi 0 l with
  | Inl said -> Proved (EachExists (lo, hi, said))
  | Inr refused -> ClaimRefused refused

(** val answer_claims : integral -> point -> point -> claim_evidence list -> answered **)

let answer_claims p lo hi l =
  match p with
  | PencilProblem q -> claims_answer p q lo hi l
  | SystemProblem (s, u) ->
    if system_wellformed s u then claims_answer p (pencil_of s u) lo hi l else EvidenceRefused
  | ZeroProblem (_, _) ->
    claims_answer p { order = 0; rows_a = []; rows_b = []; free = [] } lo hi l
  | PlainProblem _ -> EvidenceRefused

(** val told : yield list option -> (yield list -> statement) -> answered **)

let told solutions make =
  match solutions with
  | Some ys -> Proved (make ys)
  | None -> NotToldApart

(** val answer_cover : pencil -> point -> point -> cover_evidence -> answered **)

let answer_cover q lo hi = function
| CoverInWindow (claims, c, _, ls) ->
  if check_families q claims c lo hi ls
  then told (all_solutions q claims c lo hi ls) (fun ys -> AllInWindow (lo, hi,
         { solutions_in = ys; families_of_set = (families c lo hi ls); open_regions =
         (still_open c lo hi ls) }))
  else EvidenceRefused
| CoverAtValue (claims, c, ls) ->
  if (&&) (same_point lo hi) (check_at_value q lo claims c ls)
  then told (all_solutions (point_pencil q lo) claims c lo lo ls) (fun ys -> AllInWindow (lo,
         lo, { solutions_in = ys; families_of_set = (families c lo lo ls); open_regions =
         (still_open c lo lo ls) }))
  else EvidenceRefused

(** val answer_zero_cover :
    zero_system -> unknown -> point -> point -> cover_evidence -> answered **)

let answer_zero_cover z0 u lo hi = function
| CoverInWindow (claims, c, bs, ls) ->
  if check_zero_complete z0 u claims c lo hi bs ls
  then told (zero_solutions z0 u claims c lo hi bs ls) (fun ys -> AllInWindow (lo, hi,
         { solutions_in = ys; families_of_set = (zero_families c lo hi bs ls); open_regions =
         (zero_still_open z0 c lo hi bs ls) }))
  else EvidenceRefused
| CoverAtValue (_, _, _) -> EvidenceRefused

(** val answer_infinity :
    pencil -> solution_claim list -> cover -> support_leaf option list -> answered **)

let answer_infinity q claims c ls =
  if check_infinity q claims c ls
  then told (all_solutions (point_pencil (reverse_pencil q) zero) claims c zero zero ls)
         (fun ys -> AllAtInfinity { solutions_in = ys; families_of_set =
         (families c zero zero ls); open_regions = (still_open c zero zero ls) })
  else EvidenceRefused

(** val check_absence : zero_system -> point -> point -> absence_evidence -> bool **)

let check_absence z0 from bound1 = function
| ByElimination (w, tr) -> check_critical z0 w tr from bound1
| ByAnchors (w, tr) -> check_anchored_critical z0 None w tr from bound1

(** val zero_system_of : integral -> zero_system option **)

let zero_system_of = function
| SystemProblem (s, u) ->
  (match u with
   | Mu -> None
   | Lambda2 (_, _) -> Some { without_zero = s; zero_particles = [] })
| ZeroProblem (z0, u) -> (match u with
                          | Mu -> None
                          | Lambda2 (_, _) -> Some z0)
| _ -> None

(** val proved_if : bool -> statement -> answered **)

let proved_if checked s =
  if checked then Proved s else EvidenceRefused

(** val integral_answer : integral -> evidence -> answered **)

let integral_answer p = function
| ClaimsIn (lo, hi, l) -> answer_claims p lo hi l
| CoverOf (lo, hi, c) ->
  (match p with
   | PencilProblem q -> answer_cover q lo hi c
   | SystemProblem (s, u) ->
     if system_wellformed s u then answer_cover (pencil_of s u) lo hi c else EvidenceRefused
   | ZeroProblem (z0, u) -> answer_zero_cover z0 u lo hi c
   | PlainProblem _ -> EvidenceRefused)
| CoverAtInfinity (claims, c, ls) ->
  (match p with
   | PlainProblem _ -> EvidenceRefused
   | _ -> answer_infinity (pencil_of_integral p) claims c ls)
| Absence (from, bound1, a) ->
  (match zero_system_of p with
   | Some z0 -> proved_if (check_absence z0 from bound1 a) (NoneForFriction (from, bound1))
   | None -> EvidenceRefused)
| Presence (from, bound1, w, pieces) ->
  (match zero_system_of p with
   | Some z0 ->
     proved_if (check_presence z0 None w pieces from bound1) (OneForEachFriction (from, bound1))
   | None -> EvidenceRefused)
| Points points ->
  (match p with
   | PlainProblem m -> proved_if (check_mcp m points) (PointsSolve points)
   | _ -> EvidenceRefused)
| _ -> EvidenceRefused

(** val scaled_answer : problem -> scales -> evidence -> answered **)

let scaled_answer p c e =
  match scaled c p with
  | Some q -> if integral_wellformed q then integral_answer q e else EvidenceRefused
  | None -> EvidenceRefused

(** val below_zero : answered -> answered **)

let below_zero a = match a with
| Proved s -> Proved (BelowZero s)
| _ -> a

(** val joined : answered -> answered -> answered **)

let joined below1 above0 =
  match below1 with
  | Proved s ->
    (match s with
     | AllInWindow (lo, a, c) ->
       (match above0 with
        | Proved s0 ->
          (match s0 with
           | AllInWindow (lo', b, c') ->
             if (&&) (same_point lo zero) (same_point lo' zero)
             then Proved (AllOfBothSigns (a, b, (nonzero_values c), c'))
             else EvidenceRefused
           | _ -> EvidenceRefused)
        | ClaimRefused _ -> EvidenceRefused
        | x -> x)
     | _ -> (match above0 with
             | NotToldApart -> NotToldApart
             | _ -> EvidenceRefused))
  | NotToldApart -> NotToldApart
  | _ -> (match above0 with
          | NotToldApart -> NotToldApart
          | _ -> EvidenceRefused)

(** val signed_answer : rational_pencil -> rational_pencil -> scales -> evidence -> answered **)

let signed_answer q q' c e = match e with
| Reflected e0 -> below_zero (scaled_answer (GivenPencil q') c e0)
| OfBothSigns (e0, e') ->
  joined (scaled_answer (GivenPencil q') c e0) (scaled_answer (GivenPencil q) c e')
| _ -> scaled_answer (GivenPencil q) c e

(** val answer : problem -> scales -> evidence -> answered **)

let answer p c e =
  match signed_pencils p with
  | Some p0 -> let (q, q') = p0 in signed_answer q q' c e
  | None ->
    (match p with
     | GivenSystem (b, _) ->
       (match e with
        | DefiniteRates (lo, hi, w, f) ->
          proved_if (check_given_rates c b lo hi w f) (OneMotionOfRates (lo, hi))
        | Stable (lo, hi, w, d, low, high) ->
          proved_if (check_given_stable c b w d lo hi low high) (StableForFriction (lo, hi))
        | _ -> scaled_answer p c e)
     | GivenMembers (b, radii) ->
       (match e with
        | MembersAbsence (from, bound1, shares, unit0, w, tr) ->
          proved_if (check_radii_absent c b radii shares unit0 w tr from bound1)
            (NoneForFriction (from, bound1))
        | MembersPresence (from, bound1, shares, unit0, w, pieces) ->
          proved_if (check_radii_present c b radii shares unit0 w pieces from bound1)
            (OneForEachFriction (from, bound1))
        | _ -> scaled_answer p c e)
     | GivenLoads b ->
       (match e with
        | Equilibrium (mu, amounts, states0, w) ->
          proved_if (check_equilibrium b mu amounts states0 c.entry_scale w) (InEquilibrium
            (mu, amounts, states0))
        | _ -> scaled_answer p c e)
     | _ -> scaled_answer p c e)
