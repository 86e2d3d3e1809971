(* Plain mixed complementarity problems: points checked exactly.

   A problem has n rows (M_i, q_i) with integer entries, multiplied by one positive integer, and for
   each variable a lower and an upper bound, both rational or absent.  z solves it if for each i

       l_i <= z_i <= u_i,    F_i >= 0 unless z_i = u_i,    F_i <= 0 unless z_i = l_i,

   F = M z + q; an absent bound is met by no z_i.  A point is a list of integers with one common
   denominator.

   Theorem [plain_mcp_exact]: the check of a point succeeds if and only if the point is a solution.
   [plain_mcp_sound]: if all points of a list are checked, all are solutions.  Nothing is said about
   other solutions.

   Page: spec/certificates.md, 5.17.  Rust: crates/mcp (certificate of a plain problem). *)

From Mceip Require Import Base Integers Sums Condensation.

(* Numerator and denominator. *)
Definition bound := option (Z * Z)%type.

Record mcp_row := McpRow {
  row_m : sparse_row;
  row_q : Z;
  lower_bound : bound;
  upper_bound : bound }.

Definition mcp := seq mcp_row.

(* Numerators and their denominator. *)
Record mcp_point := McpPoint { numerators : seq Z; denominator : Z }.

Section Checker.

Variable p : mcp.
Local Open Scope Z_scope.

Definition no_row := McpRow [::] 0 None None.
Definition mcp_row_at i := nth no_row p i.

Definition bound_wellformed (b : bound) := if b is Some (_, den) then 0 <? den else true.

Definition row_wellformed r :=
  [&& all (fun e => e.1 < size p)%N (row_m r), bound_wellformed (lower_bound r) &
      bound_wellformed (upper_bound r)].

Variable z : mcp_point.

Notation d := (denominator z).

Definition coordinate i := nth 0 (numerators z) i.

(* d F_i *)
Definition function_value i :=
  sparse_dot (row_m (mcp_row_at i)) (numerators z) + d * row_q (mcp_row_at i).

Definition bounds_kept i :=
  (if lower_bound (mcp_row_at i) is Some (num, den) then num * d <=? coordinate i * den
   else true) &&
  (if upper_bound (mcp_row_at i) is Some (num, den) then coordinate i * den <=? num * d
   else true).

Definition at_bound (b : bound) i :=
  if b is Some (num, den) then coordinate i * den =? num * d else false.

Definition row_holds i :=
  [&& bounds_kept i, at_bound (upper_bound (mcp_row_at i)) i || (0 <=? function_value i) &
      at_bound (lower_bound (mcp_row_at i)) i || (function_value i <=? 0)].

Definition check_point :=
  [&& 0 <? d, size (numerators z) == size p & all row_holds (iota 0 (size p))].

End Checker.

Definition mcp_wellformed p := all (row_wellformed p) p.

Definition check_mcp p points :=
  [&& mcp_wellformed p, ~~ nilp points & all (check_point p) points].

Section Sound.

Variables (R : realFieldType) (p : mcp).


(* F_i *)
Definition plain_function (z : nat -> R) i : R :=
  \sum_(j <- iota 0 (size p)) toR (lookup (row_m (mcp_row_at p i)) j) * z j +
  toR (row_q (mcp_row_at p i)).

(* An absent bound is kept by every value and met by none. *)
Definition bound_value (b : Z * Z) : R := toR b.1 / toR b.2.

Definition above (b : bound) (x : R) := if b is Some v then bound_value v <= x else true.
Definition below (b : bound) (x : R) := if b is Some v then x <= bound_value v else true.
Definition meets (b : bound) (x : R) := if b is Some v then x = bound_value v else False.

Definition solves_plain (z : nat -> R) := forall i, (i < size p)%N ->
  let r := mcp_row_at p i in
  [/\ above (lower_bound r) (z i), below (upper_bound r) (z i),
      ~ meets (upper_bound r) (z i) -> 0 <= plain_function z i &
      ~ meets (lower_bound r) (z i) -> plain_function z i <= 0].

(* The point of a list of integers. *)
Definition point_value (z : mcp_point) i : R := toR (coordinate z i) / toR (denominator z).

Hypothesis wf : mcp_wellformed p.

Lemma row_parts i : (i < size p)%N ->
  [/\ all (fun e => e.1 < size p)%N (row_m (mcp_row_at p i)),
      bound_wellformed (lower_bound (mcp_row_at p i)) &
      bound_wellformed (upper_bound (mcp_row_at p i))].
Proof. by move=> lt_i; have /(all_nthP no_row)/(_ _ lt_i)/and3P[] := wf. Qed.

Section Point.

Variable z : mcp_point.
Hypothesis d0 : (0 <? denominator z)%Z.

Notation d := (denominator z).
Notation x := (point_value z).

Lemma d_gt0 : 0 < toR d :> R.
Proof. by rewrite toR_gt0. Qed.

Lemma coordinateE i : toR (coordinate z i) = x i * toR d.
Proof. by rewrite /point_value divfK // gt_eqF // d_gt0. Qed.

Lemma function_valueE i : (i < size p)%N ->
  toR (function_value p z i) = toR d * plain_function x i.
Proof.
move=> lt_i; have [cols _ _] := row_parts lt_i.
rewrite /function_value toRD toRM (toR_sparse_dot R _ cols) /plain_function mulrDr; congr (_ + _).
rewrite mulr_sumr; apply: eq_bigr => j _; rewrite -/(coordinate z j) coordinateE.
by rewrite mulrA mulrC.
Qed.

Section Bound.

Variables (b : Z * Z) (i : nat).
Hypothesis b0 : (0 <? b.2)%Z.

Let b2 : 0 < toR b.2 :> R.
Proof. by rewrite toR_gt0. Qed.

Lemma above_bound : (b.1 * d <=? coordinate z i * b.2)%Z = (bound_value b <= x i).
Proof.
rewrite -(@toR_le R) !toRM coordinateE /bound_value ler_pdivr_mulr //.
by rewrite [x i * _ * _]mulrAC ler_pmul2r // d_gt0.
Qed.

Lemma below_bound : (coordinate z i * b.2 <=? b.1 * d)%Z = (x i <= bound_value b).
Proof.
rewrite -(@toR_le R) !toRM coordinateE /bound_value ler_pdivl_mulr //.
by rewrite [x i * _ * _]mulrAC ler_pmul2r // d_gt0.
Qed.

Lemma meets_bound : (coordinate z i * b.2 =? b.1 * d)%Z <-> x i = bound_value b.
Proof.
have -> : (coordinate z i * b.2 =? b.1 * d)%Z =
          (b.1 * d <=? coordinate z i * b.2)%Z && (coordinate z i * b.2 <=? b.1 * d)%Z by lia.
rewrite above_bound below_bound; split=> [/andP[h1 h2]|->]; last by rewrite lexx.
by apply/eqP; rewrite eq_le h2.
Qed.

End Bound.

Lemma at_boundP b i : bound_wellformed b -> reflect (meets b (x i)) (at_bound z b i).
Proof.
case: b => [[num den]|] /= b0; last by constructor.
by apply: (iffP idP) => /(meets_bound (b := (num, den)) i b0).
Qed.

Lemma row_holdsP i : (i < size p)%N -> row_holds p z i <->
  let r := mcp_row_at p i in
  [/\ above (lower_bound r) (x i), below (upper_bound r) (x i),
      ~ meets (upper_bound r) (x i) -> 0 <= plain_function x i &
      ~ meets (lower_bound r) (x i) -> plain_function x i <= 0].
Proof.
move=> lt_i /=; have [_ wl wu] := row_parts lt_i; have F := function_valueE lt_i.
have geF : (0 <=? function_value p z i)%Z = (0 <= plain_function x i).
  by rewrite -(@toR_ge0 R) F pmulr_rge0 // d_gt0.
have leF : (function_value p z i <=? 0)%Z = (plain_function x i <= 0).
  by rewrite -(@toR_le0 R) F pmulr_rle0 // d_gt0.
have kept : bounds_kept p z i =
    above (lower_bound (mcp_row_at p i)) (x i) && below (upper_bound (mcp_row_at p i)) (x i).
  rewrite /bounds_kept; congr (_ && _).
    by case: (lower_bound _) wl => [[num den] b0|//]; rewrite (@above_bound (num, den)).
  by case: (upper_bound _) wu => [[num den] b0|//]; rewrite (@below_bound (num, den)).
rewrite /row_holds kept geF leF.
split=> [/and3P[/andP[a b] /orP up /orP low]|[a b up low]].
  split=> // out; first by case: up => // /(at_boundP _ wu).
  by case: low => // /(at_boundP _ wl).
rewrite a b /=; apply/andP; split.
  by case: (at_boundP i wu) => // /up.
by case: (at_boundP i wl) => // /low.
Qed.

End Point.

Theorem plain_mcp_exact (z : mcp_point) : (0 <? denominator z)%Z -> size (numerators z) = size p ->
  check_point p z <-> solves_plain (point_value z).
Proof.
move=> d0 sz; rewrite /check_point d0 sz eqxx /=; split=> [/allP holds i lt_i|sol].
  by apply/(row_holdsP d0 lt_i)/holds; rewrite mem_iota.
by apply/allP=> i; rewrite mem_iota add0n => /= lt_i; apply/(row_holdsP d0 lt_i)/sol.
Qed.

End Sound.

Theorem plain_mcp_sound (R : realFieldType) p points : check_mcp p points ->
  forall z, List.In z points -> solves_plain p (point_value R z).
Proof.
case/and3P=> wf _; elim: points => //= z points IH /andP[ok rest] z' [<-|]; last exact: IH.
by case/and3P: (ok) => d0 /eqP sz _; apply/(plain_mcp_exact R wf d0 sz).
Qed.
