(* A pencil at one value, and at infinity.

   At t = p/q the matrix is a multiple of q A + p B.  [point_pencil] has these rows for A and empty
   ones for B, so its free rows do not depend on t.  Where the window is one value, the checker
   takes the pencil at this value, whatever the free rows.

   Theorem [point_solution]: at t = p/q the pencil at (p, q) has the solutions of the pencil.
   Theorem [point_number]: if the check succeeds and [all_solutions] gives a list of N regions,
   there are N solutions at this value, and every other one belongs to a family or lies in an open
   region.
   [point_hold]: what is said of families.  [system_point_number], [system_point_hold]: the same for
   mechanical systems.

   The reverse of a pencil has the rows of A and B exchanged, but where the row of B is zero.  A
   *solution at infinity* ([at_infinity]) is an x != 0 with

       0 <= x_i _|_ y_i >= 0,   y_i = 0 for free i,   y_i = (B x)_i, or (A x)_i if row i of B is 0.

   Theorem [reverse_solution]: for t > 0 the reverse has at 1/t the solutions of the pencil at t.
   Theorem [reverse_at_zero]: its solutions at 0 are those of the pencil at infinity.
   Theorem [limit_at_infinity]: if there are solutions as near to x as one likes, with values as
   large as one likes, then x != 0 is a solution at infinity.
   [limit_motion_at_infinity]: the same of motions with (9).
   Theorem [infinity_number]: if the check of the reverse at 0 succeeds, as above, for solutions at
   infinity.  [infinity_none]: no region, no family, nothing open, no solution at infinity.
   [infinity_hold]: what is said of families.

   Page: spec/certificates.md, 5.15 (Infinity).  Rust: src/cli/infinity.rs. *)

From Mceip Require Import Base Lists Integers Sums Tree Enclosed Covered Definite Cover Condensation
  Pencil Whole Complete System Signs Support Families Varying Covers.

Section Checker.

Variable Q : pencil.

(* The rows of q A + p B. *)
Definition row_at (e : point) i : sparse_row :=
  multiple e.2 (row_a Q i) ++ multiple e.1 (row_b Q i).

Definition point_pencil (e : point) : pencil :=
  Pencil (order Q) [seq row_at e i | i <- iota 0 (order Q)] (nseq (order Q) [::])
    (free Q).

(* The families are in this value: in regions with no other. *)
Definition check_at_value (e : point) claims c ls :=
  [&& (0 <? e.2)%Z, check_families (point_pencil e) claims c e e ls &
      all (fun f => same_point (lower f.1) e && same_point (upper f.1) e) (families c e e ls)].

(* Entries at one column may cancel. *)
Definition zero_row (row : sparse_row) := all (fun c => lookup row c.1 =? 0)%Z row.

Definition reverse_pencil : pencil :=
  let constant i := zero_row (row_b Q i) in
  Pencil (order Q)
    [seq if constant i then row_a Q i else row_b Q i | i <- iota 0 (order Q)]
    [seq if constant i then [::] else row_a Q i | i <- iota 0 (order Q)] (free Q).

End Checker.

Definition check_system_at_value s u (e : point) claims c ls :=
  system_wellformed s u && check_at_value (pencil_of s u) e claims c ls.

(* Solutions at infinity: those of the reverse at 0. *)
Definition check_infinity Q claims c ls := check_at_value (reverse_pencil Q) zero claims c ls.

Lemma zero_row_lookup (row : sparse_row) : zero_row row -> forall j, lookup row j = 0%Z.
Proof.
move=> /allP zero j; have [|out] := boolP (j \in [seq c.1 | c <- row]).
  by case/mapP=> c /zero /Z.eqb_spec + ->.
exact: lookup_none.
Qed.

Section Point.

Variables (R : rcfType) (Q : pencil) (e : point).
Hypothesis finite : (0 <? e.2)%Z.

Let q0 : 0 < toR e.2 :> R.
Proof. by rewrite toR_gt0. Qed.

Lemma point_reaction (t : R) x i : i \in iota 0 (order Q) -> between t e e ->
  reaction (point_pencil Q e) t x i = toR e.2 * reaction Q t x i.
Proof.
move=> i_in [lo hi]; have at_e : t * toR e.2 = toR e.1 by apply/eqP; rewrite eq_le lo hi.
move: i_in; rewrite mem_iota add0n => /= lt_i.
rewrite /reaction mulr_sumr; apply: eq_bigr => j _.
rewrite /a_entry /b_entry {1}/row_a {1}/row_b /= nth_nseq if_same /= toR0 mulr0 addr0.
rewrite (nth_map 0%N) ?size_iota // nth_iota // add0n lookup_cat toRD !lookup_multiple -at_e.
by move: (toR _) (toR _) (toR _) (x j) => *; ring.
Qed.

Theorem point_solution (t : R) x : wellformed Q -> between t e e ->
  solution (point_pencil Q e) t x <-> solution Q t x.
Proof.
move=> wf at_e; apply: (solution_scaled (c := fun=> toR e.2)) => // i.
by rewrite mem_cat => /orP[/(free_indices wf)|/slip_indices] i_in; apply: point_reaction.
Qed.

End Point.

Section Number.

Variables (R : rcfType) (Q : pencil) (e : point).
Variables (claims : seq solution_claim) (c : cover) (ls : seq (option support_leaf)).
Hypothesis checked : check_at_value Q e claims c ls.

Notation Qe := (point_pencil Q e).
Notation families := (families c e e ls).
Notation still_open := (still_open c e e ls).

Lemma point_parts :
  [/\ (0 <? e.2)%Z, check_families Qe claims c e e ls & wellformed Q].
Proof. by case/and3P: checked => finite fam _; split=> //; case/andP: fam => /cover_wellformed. Qed.

Theorem point_number ys : all_solutions Qe claims c e e ls = Some ys ->
  all_listed (solution Q) (proportional Q) (lies_in Q) e e ys
    (unlisted (R := R) (lies_in Q) families still_open).
Proof.
have [finite fam wf] := point_parts => /(families_number R fam)[l [sz sols vals pairs every]].
exists l; split=> //.
  by move=> s /sols[sol at_e]; split=> //; apply/(point_solution finite s.2 wf at_e).
by move=> t x sol at_e; apply: every => //; apply/(point_solution finite x wf at_e).
Qed.

Theorem point_hold f : List.In f families ->
  family_solved (R := R) (lies_in Q) (solution Q) (proportional Q) f /\
  forall t : R, in_place (held_place f.2) t -> between t e e.
Proof.
have [finite fam wf] := point_parts => f_in; have [pl each] := families_hold R fam f_in.
have at_e (t : R) : in_place (held_place f.2) t -> between t e e.
  move=> /each[[x [_ [bt _]]] _]; have /and3P[_ _ inside] := checked.
  by have /andP[/same_point_eq lo /same_point_eq hi] :=
    all_In inside f_in; rewrite lo hi in bt.
split=> //; split=> // t at_t; have [[x [sol reg]] alone] := each t at_t.
have same y := point_solution finite y wf (at_e t at_t).
split; first by exists x; split=> //; apply/same.
by move=> al y y' /same sol_y reg_y /same sol_y' reg_y'; apply: (alone al).
Qed.

End Number.

(* Mechanical systems. *)
Section Systems.

Variables (R : rcfType) (s : system) (u : unknown) (e : point).
Variables (claims : seq solution_claim) (c : cover) (ls : seq (option support_leaf)).
Hypothesis checked : check_system_at_value s u e claims c ls.

Notation Q := (pencil_of s u).
Notation families := (families c e e ls).
Notation still_open := (still_open c e e ls).

Theorem system_point_number ys : all_solutions (point_pencil Q e) claims c e e ls = Some ys ->
  all_listed (satisfies_9 s u) (same_motion s) (motion_in s u) e e ys
    (unlisted (R := R) (motion_in s u) families still_open).
Proof. by case/andP: checked => wf at_e /(point_number R at_e); apply: motions_number. Qed.

Theorem system_point_hold f : List.In f families ->
  family_solved (R := R) (motion_in s u) (satisfies_9 s u) (same_motion s) f /\
  forall t : R, in_place (held_place f.2) t -> between t e e.
Proof.
by case/andP: checked => wf at_e /(point_hold R at_e)[held bt]; split=> //; apply: motions_hold.
Qed.

End Systems.

(* The reverse. *)
Section Reverse.

Variables (R : rcfType) (Q : pencil).
Implicit Types (t : R) (x : nat -> R).

Notation constant i := (zero_row (row_b Q i)).
Notation all_variables := (iota 0 (order Q)).

(* Row i of B x, or of A x where the row of B is zero. *)
Definition limit_row x i :=
  \sum_(j <- all_variables) (if constant i then a_entry R Q i j else b_entry R Q i j) * x j.

Definition at_infinity x :=
  [/\ exists2 i, i \in all_variables & x i != 0,
      forall i, i \in free Q -> limit_row x i = 0 &
      forall i, i \in slip Q -> [/\ 0 <= x i, 0 <= limit_row x i & x i * limit_row x i = 0]].

Hypothesis wf : wellformed Q.

Lemma reverse_entries i j : i \in all_variables ->
  a_entry R (reverse_pencil Q) i j = (if constant i then a_entry R Q i j else b_entry R Q i j) /\
  b_entry R (reverse_pencil Q) i j = (if constant i then 0 else a_entry R Q i j).
Proof.
rewrite mem_iota add0n => /= lt_i; rewrite /a_entry /b_entry /row_a /row_b /=.
rewrite !(nth_map 0%N) ?size_iota // nth_iota // add0n.
by case: ifP => _; split; rewrite ?toR0.
Qed.

Lemma constant_b i j : constant i -> b_entry R Q i j = 0.
Proof. by move=> zero; rewrite /b_entry (zero_row_lookup zero) toR0. Qed.

Lemma reverse_reaction t x i : i \in all_variables -> t != 0 ->
  reaction (reverse_pencil Q) t^-1 x i = (if constant i then 1 else t^-1) * reaction Q t x i.
Proof.
move=> i_in t0; rewrite /reaction mulr_sumr; apply: eq_bigr => j _.
have [-> ->] := reverse_entries j i_in; case: ifP => zero.
  by rewrite mulr0 (constant_b j zero) mulr0 !addr0 mul1r.
by rewrite mulrA mulrDr mulrA mulVf // mul1r addrC.
Qed.

Lemma reverse_row_at_zero x i : i \in all_variables ->
  reaction (reverse_pencil Q) 0 x i = limit_row x i.
Proof.
move=> i_in; apply: eq_bigr => j _; have [-> _] := reverse_entries j i_in.
by rewrite mul0r addr0.
Qed.

Let slip_in i : i \in slip Q -> i \in all_variables.
Proof. exact: slip_indices. Qed.
Let free_in i : i \in free Q -> i \in all_variables.
Proof. exact: (free_indices wf). Qed.

Theorem reverse_solution t x : 0 < t -> solution (reverse_pencil Q) t^-1 x <-> solution Q t x.
Proof.
move=> t_gt0; have t0 := lt0r_neq0 t_gt0.
apply: (solution_scaled (c := fun i => if constant i then 1 else t^-1)) => // [|i|i].
- by rewrite invr_ge0.
- by case: ifP; rewrite ?ltr01 ?invr_gt0.
by rewrite mem_cat => /orP[/free_in|/slip_in] i_in; apply: reverse_reaction.
Qed.

Theorem reverse_at_zero x : solution (reverse_pencil Q) 0 x <-> at_infinity x.
Proof.
split=> [[_ nonzero rows_f rows_s]|[nonzero rows_f rows_s]]; split=> // i Hi.
- by rewrite -reverse_row_at_zero ?free_in // rows_f.
- by rewrite -reverse_row_at_zero ?slip_in //; apply: rows_s.
- by rewrite reverse_row_at_zero ?free_in // rows_f.
by rewrite reverse_row_at_zero ?slip_in //; apply: rows_s.
Qed.

(* Limits of solutions whose values grow beyond all bounds. *)
Definition limit_solution x := forall e bound : R, 0 < e ->
  exists t y, [/\ bound < t, solution Q t y & forall i, i \in all_variables -> `|y i - x i| < e].

(* y_i of a solution, divided by t where row i of B is not zero. *)
Definition scaled_reaction t y i := (if constant i then 1 else t^-1) * reaction Q t y i.

Lemma scaled_reactionE t y i : t != 0 -> scaled_reaction t y i =
  limit_row y i +
  (if constant i then 0 else t^-1 * \sum_(j <- all_variables) a_entry R Q i j * y j).
Proof.
move=> t0; rewrite /scaled_reaction /reaction /limit_row; case: ifP => zero.
  rewrite mul1r addr0; apply: eq_bigr => j _.
  by rewrite (constant_b j zero) mulr0 addr0.
rewrite !mulr_sumr -big_split; apply: eq_bigr => j _ /=.
by rewrite addrC mulrDl mulrDr !mulrA mulVf // mul1r.
Qed.

(* It is near the row at infinity. *)
Lemma scaled_near x i e : 0 < e -> exists d bound : R, 0 < d /\ forall t y, bound < t ->
  (forall j, j \in all_variables -> `|y j - x j| < d) ->
  0 < t /\ `|scaled_reaction t y i - limit_row x i| < e.
Proof.
move=> e0; pose c j : R := if constant i then a_entry R Q i j else b_entry R Q i j.
pose C := \sum_(j <- all_variables) `|c j|.
pose D := \sum_(j <- all_variables) `|a_entry R Q i j| * (`|x j| + 1).
have C0 : 0 <= C by apply: sumr_ge0.
have D0 : 0 <= D by apply: sumr_ge0 => j _; rewrite mulr_ge0 // addr_ge0.
pose d := Num.min 1 (e / (2%:R * (C + 1))).
have C1 : 0 < C + 1 by rewrite ltr_paddl.
have d0 : 0 < d by rewrite lt_minr ltr01 divr_gt0 // mulr_gt0.
have d1 : d <= 1 by rewrite le_minl lexx.
have Cd : C * d < e / 2%:R.
  apply: (@lt_le_trans _ _ ((C + 1) * d)); first by rewrite ltr_pmul2r // ltr_addl.
  rewrite mulrC -ler_pdivl_mulr //; have -> : e / 2%:R / (C + 1) = e / (2%:R * (C + 1)).
    by rewrite invfM mulrA.
  by rewrite /d le_minl lexx orbT.
exists d, (2%:R * (D + 1) / e); split=> // t y lt_t near_y.
have D1 : 0 < D + 1 by rewrite ltr_paddl.
have t_gt0 : 0 < t by apply: lt_trans lt_t; rewrite divr_gt0 // mulr_gt0.
split=> //; rewrite scaled_reactionE ?gt_eqF // addrAC.
have first : `|limit_row y i - limit_row x i| <= C * d.
  rewrite /limit_row -sumrB mulr_suml; apply: le_trans (sum_norm _ _) _.
  by apply: sum_le => j Hj; rewrite -mulrBr normrM ler_wpmul2l // ltW // near_y.
have second : `|if constant i then 0 else t^-1 *
    \sum_(j <- all_variables) a_entry R Q i j * y j| < e / 2%:R.
  case: ifP => _; first by rewrite normr0 divr_gt0 ?ltr0n.
  have le_D : `|\sum_(j <- all_variables) a_entry R Q i j * y j| <= D.
    apply: le_trans (sum_norm _ _) _; apply: sum_le => j Hj.
    rewrite normrM ler_wpmul2l // -[y j](subrK (x j)) addrC.
    apply: le_trans (ler_norm_add _ _) _; rewrite ler_add2l.
    exact: le_trans (ltW (near_y j Hj)) d1.
  rewrite normrM gtr0_norm ?invr_gt0 // mulrC ltr_pdivr_mulr //.
  apply: (@le_lt_trans _ _ D) => //; rewrite mulrAC ltr_pdivl_mulr ?ltr0n // mulrC.
  move: lt_t; rewrite ltr_pdivr_mulr // [t * e]mulrC; apply: le_lt_trans.
  by rewrite [D * _]mulrC ler_wpmul2l ?ler0n // ler_addl ler01.
apply: le_lt_trans (ler_norm_add _ _) _.
by rewrite [X in _ < X]splitr ltr_add // (le_lt_trans first).
Qed.

Theorem limit_at_infinity x : (exists2 i, i \in all_variables & x i != 0) ->
  limit_solution x -> at_infinity x.
Proof.
move=> nonzero limit.
(* A solution as near as one likes, and y_i too. *)
have near i e : 0 < e -> exists t y, [/\ 0 < t, solution Q t y,
    `|scaled_reaction t y i - limit_row x i| < e &
    forall j, j \in all_variables -> `|y j - x j| < e].
  move=> e0; have [d [bound [d0 close]]] := scaled_near x i e0.
  have d'0 : 0 < Num.min d e by rewrite lt_minr d0 e0.
  have [t [y [lt_t sol near_y]]] := limit _ bound d'0.
  have [|t0 row] := close t y lt_t; first by move=> j /near_y; rewrite lt_minr => /andP[].
  by exists t, y; split=> // j /near_y; rewrite lt_minr => /andP[].
have factor0 t i : 0 < t -> 0 < (if constant i then 1 else t^-1) :> R.
  by move=> t0; case: ifP; rewrite ?ltr01 ?invr_gt0.
(* A number near numbers >= 0 is not negative. *)
have ge0 (a : R) : (forall e, 0 < e -> exists2 b, 0 <= b & `|b - a| < e) -> 0 <= a.
  move=> close; rewrite leNgt; apply/negP => a0.
  have [|b b0] := close (- a); first by rewrite oppr_gt0.
  by rewrite ltr_distl subrr => /andP[_]; rewrite ltNge b0.
split=> // i Hi.
  apply/eqP; rewrite -normr_eq0; apply/eqP/le_anti; rewrite normr_ge0 andbT leNgt; apply/negP => y0.
  have [t [y [_ [_ _ rows_f _] close _]]] := near i _ y0.
  by move: close; rewrite /scaled_reaction rows_f // mulr0 sub0r normrN ltxx.
have x0 : 0 <= x i.
  apply: ge0 => e e0; have [t [y [_ [_ _ _ rows_s] _ close]]] := near i e e0.
  by exists (y i); [have [] := rows_s i Hi | apply: close; apply: slip_in].
have y0 : 0 <= limit_row x i.
  apply: ge0 => e e0; have [t [y [t0 [_ _ _ rows_s] close _]]] := near i e e0.
  exists (scaled_reaction t y i) => //; have [_ yi _] := rows_s i Hi.
  by rewrite /scaled_reaction mulr_ge0 // ltW // factor0.
split=> //; apply/eqP; rewrite mulf_eq0; apply: contraT; rewrite negb_or => /andP[xn yn].
have x_gt0 : 0 < x i by rewrite lt_neqAle eq_sym xn.
have y_gt0 : 0 < limit_row x i by rewrite lt_neqAle eq_sym yn.
have e0 : 0 < Num.min (x i) (limit_row x i) by rewrite lt_minr x_gt0.
have [t [y [t0 [_ _ _ rows_s] close_y close_x]]] := near i _ e0.
have [_ _ /eqP] := rows_s i Hi; rewrite mulf_eq0 => /orP[]/eqP zero.
  by have := close_x i (slip_in Hi); rewrite zero sub0r normrN gtr0_norm // lt_minr ltxx.
move: close_y; rewrite /scaled_reaction zero mulr0 sub0r normrN gtr0_norm //.
by rewrite lt_minr ltxx andbF.
Qed.

End Reverse.

Section Infinity.

Variables (R : rcfType) (Q : pencil) (claims : seq solution_claim) (c : cover).
Variable ls : seq (option support_leaf).
Hypothesis checked : check_infinity Q claims c ls.

Notation families := (families c zero zero ls).
Notation still_open := (still_open c zero zero ls).

Lemma at_zero (t : R) : between t zero zero <-> t = 0.
Proof.
rewrite /between /= toR0 toR1 mulr1; split=> [[lo hi]|->]; last by rewrite lexx.
by apply/eqP; rewrite eq_le hi lo.
Qed.

Lemma infinity_wellformed : wellformed Q.
Proof. by have [_ _] := point_parts checked. Qed.

Lemma place_inhabited pl : is_place R pl -> exists t : R, in_place pl t.
Proof.
case: pl => [v|v v'|v] /=.
- by case=> s [is_s _]; exists s.
- case=> s [s' [_ _ lt_s inside]]; exists ((s + s') / 2%:R); apply/inside.
  by rewrite (midf_lt lt_s).1 (midf_lt lt_s).2.
by case=> s _ above; exists (s + 1); apply/above; rewrite ltr_addl ltr01.
Qed.

Theorem infinity_number ys :
  all_solutions (point_pencil (reverse_pencil Q) zero) claims c zero zero ls = Some ys ->
  exists l : seq (nat -> R),
    [/\ size l = size ys, forall x, List.In x l -> at_infinity Q x,
        List.Forall2 (fun y x => lies_in Q (yield_region y) 0 x) ys l,
        List.ForallOrdPairs (fun x x' => ~ proportional Q x x') l &
        forall x : nat -> R, at_infinity Q x ->
          [\/ exists2 x', List.In x' l & proportional Q x' x,
              exists2 f, List.In f families & in_family (lies_in Q) f 0 x |
              exists2 r, List.In r still_open & lies_in Q r 0 x]].
Proof.
have wf := infinity_wellformed; move/(point_number R checked)=> [l [sz sols vals pairs every]].
have value0 s : List.In s l -> s.1 = 0 by move=> /sols[_ /at_zero].
exists [seq s.2 | s <- l]; split.
- by rewrite size_map.
- move=> x /List.in_map_iff[s [<- s_in]]; have [sol _] := sols s s_in.
  by apply/(reverse_at_zero wf); rewrite -(value0 s s_in).
- elim: vals value0 {sz sols pairs every} => [|y s ys' l' [_ reg] _ IH] value0 /=; constructor.
    by move: reg; rewrite value0 //; left.
  by apply: IH => s' s'_in; apply: value0; right.
- elim: pairs value0 {sz sols vals every} => [|s l' different _ IH] value0 /=; constructor.
    apply/List.Forall_forall => x /List.in_map_iff[s' [<- s'_in]] prop.
    have /List.Forall_forall/(_ _ s'_in) := different; apply; split=> //.
    by rewrite !value0 //; [left | right].
  by apply: IH => s' s'_in; apply: value0; right.
move=> x /(reverse_at_zero wf) sol; have [|[s s_in [_ prop]]|[f_in|r_in]] := every 0 x sol.
- exact/at_zero.
- by apply: Or31; exists s.2 => //; apply: List.in_map.
- exact: Or32.
exact: Or33.
Qed.

Corollary infinity_none :
  all_solutions (point_pencil (reverse_pencil Q) zero) claims c zero zero ls = Some [::] ->
  families = [::] -> still_open = [::] -> forall x : nat -> R, at_infinity Q x -> False.
Proof.
move=> /infinity_number[l [/size0nil-> _ _ _ every]] no_family closed x sol.
by have [[x']|[f]|[r]] := every x sol; rewrite ?no_family ?closed.
Qed.

Theorem infinity_hold f : List.In f families ->
  (exists x : nat -> R, at_infinity Q x /\ lies_in Q f.1 0 x) /\
  (held_alone f.2 -> forall x x' : nat -> R, at_infinity Q x -> lies_in Q f.1 0 x ->
     at_infinity Q x' -> lies_in Q f.1 0 x' -> proportional Q x x').
Proof.
have wf := infinity_wellformed => /(point_hold R checked)[[pl each] value0].
have [t at_t] := place_inhabited pl; have [[x [sol reg]] alone] := each t at_t.
have /at_zero t0 := value0 t at_t.
rewrite {t}t0 in sol reg alone {at_t}; split.
  by exists x; split=> //; apply/(reverse_at_zero wf).
move=> al y y' /(reverse_at_zero wf) sol_y reg_y /(reverse_at_zero wf) sol_y' reg_y'.
exact: (alone al).
Qed.

End Infinity.

(* Limits of motions. *)
Section Limits.

Variables (R : rcfType) (s : system) (u : unknown).
Hypothesis wf : system_wellformed s u.

Notation Q := (pencil_of s u).
Notation all_dofs := (iota 0 (dofs s)).
Notation nf := (free_number s).
Notation L := (toR (unit_length s) : R).

Definition limit_motion (v : nat -> R) := forall e bound : R, 0 < e ->
  exists t v', [/\ bound < t, satisfies_9 s u t v' & forall d, d \in all_dofs -> `|v' d - v d| < e].

(* How much faster than the motion its variables change. *)
Definition change i : R :=
  if (i < nf)%N then L^-1
  else let p := particle s (i - nf) in
       `|toR (sign_of p)| * (`|toR (tangent p).1| + `|toR (tangent p).2|) / L ^+ 2.

Lemma change_ge0 i : 0 <= change i.
Proof.
have L0 : 0 < L := unit_length_gt0 R wf; rewrite /change; case: ifP => _.
  by rewrite invr_ge0 ltW.
by rewrite divr_ge0 ?mulr_ge0 ?addr_ge0 ?exprn_ge0 // ltW.
Qed.

Lemma variables_near v v' e i : i \in iota 0 (order Q) ->
  (forall d, d \in all_dofs -> `|v' d - v d| <= e) ->
  `|variables_of s v' i - variables_of s v i| <= change i * e.
Proof.
rewrite mem_iota add0n => /= lt_i near; have L0 : 0 < L := unit_length_gt0 R wf.
rewrite /variables_of /change; have [lt_f|ge_f] := ltnP i nf.
  rewrite -mulrBl normrM [`|L^-1|]gtr0_norm ?invr_gt0 // mulrC ler_wpmul2l ?invr_ge0 ?(ltW L0) //.
  by apply: near; apply: (free_dof_in wf).
have lt_j : (i - nf < size (particles s))%N by rewrite -(ltn_add2l nf) subnKC.
set p := particle s (i - nf); have l2 : 0 < L ^+ 2 by rewrite exprn_gt0.
rewrite opprK addrC -mulrBl normrM [`|(L ^+ 2)^-1|]gtr0_norm ?invr_gt0 //.
rewrite [X in _ <= X]mulrAC ler_wpmul2r ?invr_ge0 ?(ltW l2) //.
rewrite /slip_rate /along -mulrBr normrM -mulrA ler_wpmul2l //.
have -> : toR (tangent p).1 * v (first_dof p) + toR (tangent p).2 * v (second_dof p) -
    (toR (tangent p).1 * v' (first_dof p) + toR (tangent p).2 * v' (second_dof p)) =
    - (toR (tangent p).1 * (v' (first_dof p) - v (first_dof p)) +
       toR (tangent p).2 * (v' (second_dof p) - v (second_dof p))).
  by move: (v _) (v _) (v' _) (v' _) (toR _) (toR _) => *; ring.
rewrite normrN (le_trans (ler_norm_add _ _)) // mulrDl !normrM ler_add // ler_wpmul2l // near //.
  exact: (first_dof_in wf).
exact: (second_dof_in wf).
Qed.

Theorem limit_motion_at_infinity v : (exists2 d, d \in all_dofs & v d != 0) -> limit_motion v ->
  at_infinity Q (variables_of s v).
Proof.
case=> d d_in vd limit.
have near e bound : 0 < e -> exists t v', [/\ bound < t, satisfies_9 s u t v',
    forall d', d' \in all_dofs -> `|v' d' - v d'| < e &
    forall i, i \in iota 0 (order Q) -> `|variables_of s v' i - variables_of s v i| < e].
  move=> e0; pose C := \sum_(i <- iota 0 (order Q)) change i.
  have C0 : 0 <= C by apply: sumr_ge0 => i _; apply: change_ge0.
  have C1 : 0 < C + 1 by apply: ltr_paddl C0 ltr01.
  have e'0 : 0 < e / (C + 1) by rewrite divr_gt0.
  have le_e : e / (C + 1) <= e by rewrite ler_pdivr_mulr // ler_pmulr // ler_addr.
  have [t [v' [lt_t sat close]]] := limit _ bound e'0; exists t, v'; split=> // [d' d'_in|i Hi].
    exact: lt_le_trans (close d' d'_in) le_e.
  apply: le_lt_trans (variables_near Hi (fun d' d'_in => ltW (close d' d'_in))) _.
  have ge_i : change i <= C.
    rewrite /C (bigD1_seq i) ?iota_uniq //= ler_addl sumr_ge0 // => k _; exact: change_ge0.
  rewrite mulrA ltr_pdivr_mulr // mulrC ltr_pmul2l //.
  by apply: le_lt_trans ge_i _; rewrite ltr_addl ltr01.
apply: limit_at_infinity; last first.
  move=> e bound e0; have [t [v' [lt_t sat _ close]]] := near e bound e0.
  by exists t, (variables_of s v'); split=> //; apply: (solution_of_motion wf).
apply/hasP; apply: contraNT vd => /hasPn none.
have zero i : i \in iota 0 (order Q) -> variables_of s v i = 0.
  by move=> /none; rewrite negbK => /eqP.
rewrite -normr_eq0 eq_le normr_ge0 andbT leNgt; apply/negP => v0.
pose c : R := if column s d is Some (_, a) then `|toR a| else 0.
have c0 : 0 <= c by rewrite /c; case: (column s d) => [[]|].
pose e := `|v d| / (2%:R + c).
have c2 : 0 < 2%:R + c by rewrite ltr_paddr ?ltr0n.
have e0 : 0 < e by rewrite divr_gt0.
have [t [v' [_ sat close_v close_x]]] := near e 0 e0.
have small : `|v' d| <= c * e.
  rewrite -(system_onto wf sat d_in) /motion /c; case col: (column s d) => [[j a]|]; last first.
    by rewrite normr0 mul0r.
  have j_in : j \in iota 0 (order Q) by rewrite mem_iota add0n; apply: column_in_range col.
  rewrite normrM ler_wpmul2l //; have := close_x j j_in.
  by rewrite zero // subr0 => /ltW.
have : `|v d| <= e + c * e.
  rewrite -[v d](subrK (v' d)) (le_trans (ler_norm_add _ _)) // ler_add // distrC ltW //.
  exact: close_v.
rewrite -{1}[e]mul1r -mulrDl /e mulrA ler_pdivl_mulr // mulrC ler_pmul2r // leNgt.
by rewrite ltr_add2r ltr1n.
Qed.

End Limits.
