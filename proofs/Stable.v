(* Stability of an equilibrium, for the problem as it is written.

   Stability.v speaks of coordinates of admissible motions and of integers; here its conclusion
   [motions_stable] becomes [stable_at] of Statement.v.  The coordinates X v of a motion v are its
   free degrees of freedom and the slides of its slip particles, divided by the length L of the
   tangents; forces are C times the true ones, and C L times at slip particles.  [inner_moved]: the
   inner product of a motion and forces, in coordinates.

   Theorem [stability_sound]: if the check succeeds, then the equilibrium is stable for each mu of
   the interval, in the sense of [stable_at].

   Page: spec/certificates.md, 5.21.  Rust: crates/check/src/stability.rs. *)

From Mceip Require Import Base Integers Sums Tree Covered Norms Elimination Condensation Pencil
  System ZeroReaction ZeroPencil Energy Rational Statement Integral Stability.

(* The problem as it is written. *)

Definition check_given_stable c B w d lo hi low high :=
  [&& exact_system c B, nilp (with_zero B) &
      check_stable (entry_scale c) (scaled_system c B) w d lo hi low high].

Section Given.

Variables (R : rcfType) (c : scales) (B : rational_system) (w : elimination) (d : stability).
Variables (lo hi : point) (low high : stable_end).
Hypothesis checked : check_given_stable c B w d lo hi low high.
Implicit Types (v u f : nat -> R).

Notation s := (scaled_system c B).
Notation nf := (free_number s).
Notation ns := (size (particles s)).
Notation n := (nf + ns)%N.
Notation fi := (iota 0 nf).
Notation si := (iota 0 ns).
Notation ix := (iota 0 n).
Notation all_dofs := (iota 0 (degrees B)).
Notation C := (toR (entry_scale c) : R).
Notation L := (toR (length_scale c) : R).
Notation KK := (KK R s).
Notation MM := (MM R s).
Notation RR := (RR R s).
Notation NN := (NN R s).
Notation dof k := (nth 0%N (free_dofs s) k).
Notation X := (variables_of s).
Notation moved x := (motion s x).

Lemma exact_B : exact_system c B.
Proof. by case/and3P: checked. Qed.

Lemma no_zero : with_zero B = [::].
Proof. by case/and3P: checked => _ /nilP. Qed.

Lemma stable_s : check_stable (entry_scale c) s w d lo hi low high.
Proof. by case/and3P: checked. Qed.

Lemma wf_s : system_wellformed s Mu.
Proof. exact: (wf stable_s). Qed.

Lemma C0 : 0 < C.
Proof. by have [] := scales_gt0 R exact_B. Qed.

Lemma LL0 : 0 < L.
Proof. by have [] := scales_gt0 R exact_B. Qed.

Lemma size_s : ns = size (slipping B).
Proof. by rewrite size_map. Qed.

Lemma inert_scaled v i : inert s v i = C * inertia_of B v i.
Proof.
rewrite /inert !(force_scaled exact_B) -mulrBr /force_of /product /inertia_of -sumrB; congr (_ * _).
by apply: eq_bigr => j _; move: (given_entry _ _ _ _) (given_entry _ _ _ _) (v j) => *; ring.
Qed.

(* Motions and their coordinates. *)

Lemma restored v : admissible B v -> forall i, i \in all_dofs -> moved (X v) i = v i.
Proof.
case=> stuck contact; apply: (motion_restored wf_s) => [i Hi out|j lt_j].
  apply: stuck => //; rewrite -(stick_scaled exact_B Hi) (without_zero_scaled c no_zero).
  by rewrite /moving_with_zero cats0.
have lt_j' : (j < size (slipping B))%N by rewrite -size_s.
have [eq_k ex_p] := slip_scaled exact_B lt_j'.
by rewrite eq_k normal_scaled // contact ?mulr0 // mem_iota.
Qed.

Lemma same_force l v : admissible B v -> forall i, force s l (moved (X v)) i = force s l v i.
Proof. by move=> adm i; apply: sum_eq => j Hj; rewrite restored. Qed.

Lemma same_inert v : admissible B v -> forall i, inert s (moved (X v)) i = inert s v i.
Proof. by move=> adm i; rewrite /inert !same_force. Qed.

(* v'f in coordinates *)
Lemma sum_moved x f : \sum_(i <- all_dofs) moved x i * f i =
  \sum_(k <- fi) x k * (L * f (dof k)) +
  \sum_(j <- si) x (nf + j)%N * - (toR (sign_of (particle s j)) *
    along (tangent (particle s j)) (particle s j) f).
Proof.
have [um _ _ _ _] := wf_parts wf_s.
have -> : \sum_(i <- all_dofs) moved x i * f i = \sum_(i <- moving_dofs s) moved x i * f i.
  apply: (sum_subset (iota_uniq _ _) um) => [i|i _ out]; first exact: (moving_dof_in wf_s).
  by rewrite motion_zero ?mul0r.
rewrite /moving_dofs /first_dofs /second_dofs !big_cat (big_map first_dof) (big_map second_dof).
congr (_ + _).
  rewrite sum_positions; apply: sum_eq => k; rewrite mem_iota add0n => /= lt_k.
  by rewrite (motion_free wf_s) // mulrA [L * x k]mulrC -mulrA.
rewrite -big_split /= (big_nth (SlipParticle 0 0 (0, 0) (0, 0) 0 0)%Z) /index_iota subn0.
apply: sum_eq => j; rewrite mem_iota add0n => /= lt_j; rewrite -/(particle s j).
have firstE : moved x (first_dof (particle s j)) =
    - (toR (sign_of (particle s j)) * toR (tangent (particle s j)).1) * x (nf + j)%N.
  by rewrite /motion (column_first wf_s lt_j) toRN toRM.
have secondE : moved x (second_dof (particle s j)) =
    - (toR (sign_of (particle s j)) * toR (tangent (particle s j)).2) * x (nf + j)%N.
  by rewrite /motion (column_second wf_s lt_j) toRN toRM.
rewrite firstE secondE /along; move: (f _) (f _) (x _) => *.
by move: (toR _) (toR _) (toR _) => *; ring.
Qed.

Lemma inner_moved v f : admissible B v -> inner_product B v f =
  \sum_(k <- fi) X v k * (L * f (dof k)) +
  \sum_(j <- si) X v (nf + j)%N * - (toR (sign_of (particle s j)) *
    along (tangent (particle s j)) (particle s j) f).
Proof.
by move=> adm; rewrite -sum_moved; apply: sum_eq => i Hi; rewrite restored.
Qed.

Lemma pair_k v u : admissible B v -> admissible B u ->
  pair n KK (X v) (X u) = C * inner_product B v (force_of B 0 u).
Proof.
move=> adm_v adm_u; rewrite [RHS](_ : _ = inner_product B v (force s 0 u)); last first.
  by rewrite mulr_sumr; apply: eq_bigr => i _; rewrite (force_scaled exact_B) mulrCA.
rewrite inner_moved // /pair sum_parts; congr (_ + _); apply: sum_eq => k.
  rewrite mem_iota add0n => /= lt_k.
  by rewrite (free_k stable_s) // same_force.
rewrite mem_iota add0n => /= lt_k; rewrite (slip_k stable_s) //.
by rewrite /along !same_force.
Qed.

Lemma pair_m v u : admissible B v -> admissible B u ->
  pair n MM (X v) (X u) = C * inner_product B v (inertia_of B u).
Proof.
move=> adm_v adm_u; rewrite [RHS](_ : _ = inner_product B v (inert s u)); last first.
  by rewrite mulr_sumr; apply: eq_bigr => i _; rewrite inert_scaled mulrCA.
rewrite inner_moved // /pair sum_parts; congr (_ + _); apply: sum_eq => k.
  rewrite mem_iota add0n => /= lt_k.
  by rewrite (free_m stable_s) // same_inert.
rewrite mem_iota add0n => /= lt_k; rewrite (slip_m stable_s) //.
by rewrite /along !same_inert.
Qed.

Lemma X_slip v j : j \in si -> X v (nf + j)%N = slide B v j / L.
Proof.
rewrite mem_iota add0n => /= lt_j; have lt_j' : (j < size (slipping B))%N by rewrite -size_s.
have [eq_k ex_p] := slip_scaled exact_B lt_j'.
rewrite /variables_of ltnNge leq_addr /= addKn eq_k slip_rate_scaled // /slide.
move: (toR (sign _)) (tangential _ _) (lt0r_neq0 LL0) => a b l0.
by field.
Qed.

Lemma X_sub v u i : X (fun k => v k - u k) i = X v i - X u i.
Proof.
rewrite /variables_of; case: ifP => _; first by rewrite mulrBl.
by rewrite /slip_rate /along; move: (v _) (v _) (u _) (u _) (toR _) (toR _) (toR _) => *; ring.
Qed.

Lemma square_X v : admissible B v -> inner_product B v v = L ^+ 2 * \sum_(i <- ix) X v i ^+ 2.
Proof.
move=> adm; rewrite inner_moved // sum_parts mulrDr !mulr_sumr; congr (_ + _).
  apply: sum_eq => k; rewrite mem_iota add0n => /= lt_k.
  rewrite -(restored adm (free_dof_in wf_s lt_k)).
  by rewrite (motion_free wf_s) // -[unit_length s]/(length_scale c); move: (X v k) L => *; ring.
apply: sum_eq => j; rewrite mem_iota add0n => /= lt_j.
have tE : toR (sign_of (particle s j)) * along (tangent (particle s j)) (particle s j) v =
    slip_rate (moved (X v)) (particle s j).
  by rewrite /slip_rate /along !restored // ?(first_dof_in wf_s) ?(second_dof_in wf_s).
by rewrite tE (slip_motion wf_s) // -[unit_length s]/(length_scale c); move: (X v _) L => *; ring.
Qed.

(* Forces. *)

Lemma margin_k v mu j : admissible B v -> j \in si ->
  still_force nf ns KK RR mu (X v) j = C * L * cone_margin B mu (force_of B 0 v) j.
Proof.
move=> adm; rewrite mem_iota add0n => /= lt_j.
have lt_j' : (j < size (slipping B))%N by rewrite -size_s.
have [eq_k ex_p] := slip_scaled exact_B lt_j'.
rewrite /still_force (slip_k stable_s) // (slip_r stable_s) // eq_k.
have alongE e p : along e p (force s 0 (moved (X v))) = along e p (force s 0 v).
  by rewrite /along !same_force.
rewrite !alongE (tangent_force_scaled exact_B) // (normal_force_scaled exact_B) // /cone_margin /=.
by move: (tangential _ _) (normal_to _ _) (fraction _ _) => *; ring.
Qed.

Lemma margin_all v a mu j : admissible B v -> admissible B a -> j \in si ->
  slip_force nf ns KK MM RR NN mu (X v) (X a) j =
  C * L * cone_margin B mu (fun i => force_of B 0 v i + inertia_of B a i) j.
Proof.
move=> adm_v adm_a Hj; have := margin_k mu adm_v Hj; rewrite /still_force /slip_force.
move: Hj; rewrite mem_iota add0n => /= lt_j.
have lt_j' : (j < size (slipping B))%N by rewrite -size_s.
have [eq_k ex_p] := slip_scaled exact_B lt_j'.
have mE : times n MM (X a) (nf + j)%N + mu * times n NN (X a) j =
    C * L * cone_margin B mu (inertia_of B a) j.
  rewrite (slip_m stable_s) // (slip_n stable_s) // eq_k.
  have -> : along (tangent (scaled_particle c (slip_at B j))) (scaled_particle c (slip_at B j))
      (inert s (moved (X a))) = C * (L * tangential (slip_at B j) (inertia_of B a)).
    rewrite tangent_scaled // /tangential !same_inert // !inert_scaled.
    by move: (inertia_of _ _ _) (inertia_of _ _ _) (fraction _ _) (fraction _ _) => *; ring.
  have -> : along (normal (scaled_particle c (slip_at B j))) (scaled_particle c (slip_at B j))
      (inert s (moved (X a))) =
      C * (L * fraction R (factor_of (slip_at B j)) * normal_to (slip_at B j) (inertia_of B a)).
    rewrite normal_scaled // /normal_to !same_inert // !inert_scaled.
    by move: (inertia_of _ _ _) (inertia_of _ _ _) (fraction _ _) (fraction _ _) => *; ring.
  by rewrite /cone_margin /=; move: (tangential _ _) (normal_to _ _) (fraction _ _) => *; ring.
move=> kE; have -> : times n KK (X v) (nf + j)%N + times n MM (X a) (nf + j)%N +
    mu * (times n RR (X v) j + times n NN (X a) j) =
    (times n KK (X v) (nf + j)%N + mu * times n RR (X v) j) +
    (times n MM (X a) (nf + j)%N + mu * times n NN (X a) j) by ring.
rewrite kE mE -mulrDr; congr (_ * _); rewrite /cone_margin /tangential /normal_to.
by move: (fraction _ _) (fraction _ _) (fraction _ _) (fraction _ _) (fraction _ _) => *; ring.
Qed.

Lemma free_forces v : admissible B v -> free_of_forces B (force_of B 0 v) ->
  forall k, k \in fi -> times n KK (X v) k = 0.
Proof.
move=> adm none k; rewrite mem_iota add0n => /= lt_k; rewrite (free_k stable_s) // same_force //.
have := mem_nth 0%N lt_k; rewrite mem_filter => /andP[out Hk].
by rewrite (force_scaled exact_B) none // !mulr0.
Qed.

Lemma follows_carried u v : carried B u v -> follows nf ns KK (X u) (X v).
Proof.
case=> adm none same; split; first exact: free_forces.
by move=> j Hj; rewrite !X_slip // same // -size_s.
Qed.

Lemma energy_definite : definite_energy R B.
Proof.
have h0 := heaviness0 R stable_s; have C0 := C0; have LL0 := LL0.
have l2 : 0 < L ^+ 2 by rewrite exprn_gt0.
have sg := sigma0 R stable_s.
exists (heaviness R d / (C * L ^+ 2)), ((toR (bound_d w) / toR (bound_c w)) / (C * L)).
have cl : 0 < C * L ^+ 2 by rewrite mulr_gt0.
have cl1 : 0 < C * L by rewrite mulr_gt0.
split=> [||v adm|v adm rest|v u adm_v adm_u].
- exact: divr_gt0.
- exact: divr_gt0.
- rewrite -(ler_pmul2l C0) -pair_m // square_X //.
  have := heavy stable_s (X v); apply: le_trans; rewrite le_eqVlt; apply/orP; left; apply/eqP.
  by move: (\sum_(i <- ix) _) => y; field; rewrite ?gt_eqF.
- have off j : j \in si -> X v (nf + j)%N = 0.
    by move=> Hj; rewrite X_slip // rest ?mul0r // -size_s.
  rewrite -(ler_pmul2l C0) -pair_k // (pair_free stable_s off) square_X // sum_parts.
  rewrite [X in _ * (_ + X)]sum_zero ?addr0 => [|j /off->]; last by rewrite expr0n.
  have := below_F stable_s (X v); rewrite -pair_form => le.
  apply: le_trans (ler_wpmul2l (ltW LL0) le); rewrite le_eqVlt; apply/orP; left; apply/eqP.
  move: (lt0r_neq0 C0) (lt0r_neq0 LL0).
  move: (\sum_(i <- fi) _) (toR (bound_d w) / toR (bound_c w)) C L => y k c' l' c0 l0.
  by field; rewrite ?c0 ?l0.
split; apply: (mulfI (lt0r_neq0 C0)).
  by rewrite -!pair_m //; apply: pair_sym; apply: (sym_m R stable_s).
by rewrite -!pair_k //; apply: pair_sym; apply: (sym_k R stable_s).
Qed.

Theorem stability_sound mu : between mu lo hi -> stable_at B (mu : R).
Proof.
move=> bm; split; [exact: no_zero | | exact: energy_definite |].
  by rewrite -(flat_scaled exact_B); apply: wellformed_flat wf_s.
have [form [slope [drift [sym pos def bel pow]]]] := stable_motions stable_s C0 bm.
have C0 := C0; have LL0 := LL0; have cl : 0 < C * L by rewrite mulr_gt0.
rewrite size_s in sym pos def.
exists form, slope, drift; split=> // [x _|u cu u0 i Hi|v r a u z e g inst cu cz eE gE].
- exact: def.
- have [adm none _] := cu; rewrite -(ler_pmul2l cl).
  have Hi' : i \in si by rewrite size_s.
  rewrite -(margin_k mu adm Hi'); apply: le_trans (bel _ (free_forces adm none) _ i Hi').
    rewrite mulr_sumr le_eqVlt size_s; apply/orP; left; apply/eqP; apply: sum_eq => j Hj.
    rewrite X_slip ?size_s //; move: (form i j) (drift i) (slide _ _ _) (lt0r_neq0 LL0).
    by move: C L => c' l' f' d' x' l0; field.
  by move=> j Hj; rewrite X_slip // divr_ge0 ?(ltW LL0) // u0 // -size_s.
case: inst => adm_v adm_r adm_a none laws.
have [adm_u _ _] := cu; have [adm_z _ _] := cz.
have adm_e : admissible B e.
  case: adm_v adm_u => v1 v2 [u1 u2]; split=> [i Hi st|j Hj]; first by rewrite eE v1 // u1 // subrr.
  have -> : normal_to (slip_at B j) e = normal_to (slip_at B j) v - normal_to (slip_at B j) u.
    by rewrite /normal_to !eE; move: (fraction _ _) (fraction _ _) => *; ring.
  by rewrite v2 // u2 // subrr.
have adm_g : admissible B g.
  case: adm_r adm_z => v1 v2 [u1 u2]; split=> [i Hi st|j Hj]; first by rewrite gE v1 // u1 // subrr.
  have -> : normal_to (slip_at B j) g = normal_to (slip_at B j) r - normal_to (slip_at B j) z.
    by rewrite /normal_to !gE; move: (fraction _ _) (fraction _ _) => *; ring.
  by rewrite v2 // u2 // subrr.
have law : free_law nf ns KK MM (X v) (X a).
  move=> k; rewrite mem_iota add0n => /= lt_k.
  rewrite (free_k stable_s) // (free_m stable_s) // same_force // same_inert //.
  have := mem_nth 0%N lt_k; rewrite mem_filter => /andP[out Hk].
  rewrite (force_scaled exact_B) inert_scaled -!mulrDr.
  by have := none _ Hk out; rewrite /= => ->; rewrite !mulr0.
have inst j : j \in si -> [/\ 0 <= X r (nf + j)%N,
    X r (nf + j)%N * slip_force nf ns KK MM RR NN mu (X v) (X a) j = 0 &
    X a (nf + j)%N * slip_force nf ns KK MM RR NN mu (X v) (X a) j = 0].
  move=> Hj; have [|r0 _ zero zero_a] := laws j; first by rewrite -size_s.
  set all := cone_margin _ _ _ j in zero zero_a.
  have zeroE f : slide B f j * all = 0 -> slide B f j / L * (C * L * all) = 0.
    by rewrite [C * L * _]mulrC mulrACA => ->; rewrite mul0r.
  rewrite margin_all // !X_slip //; split; [|exact: zeroE|exact: zeroE].
  by rewrite divr_ge0 // ltW.
have := pow (X v) (X a) (X r) (X u) (X z) law inst (follows_carried cu) (follows_carried cz).
lazy zeta; set p1 := pair n MM _ _.
have eE' i : X v i - X u i = X e i.
  rewrite -X_sub /variables_of /slip_rate /along.
  by case: ifP => _; rewrite !eE.
have gE' i : X r i - X z i = X g i.
  rewrite -X_sub /variables_of /slip_rate /along.
  by case: ifP => _; rewrite !gE.
have pairE : pair n KK (fun i => X r i - X z i) (fun i => X v i - X u i) = pair n KK (X g) (X e).
  by apply: eq_bigr => i _; rewrite gE'; congr (_ * _); apply: eq_bigr => j _; rewrite eE'.
have pairE' : pair n KK (fun i => X v i - X u i) (fun i => X v i - X u i) = pair n KK (X e) (X e).
  by apply: eq_bigr => i _; rewrite eE'; congr (_ * _); apply: eq_bigr => j _; rewrite eE'.
rewrite pairE pairE' /p1 pair_m // !pair_k // -mulrDr => le.
rewrite -(ler_pmul2l C0); apply: le_trans le _; rewrite [X in _ <= X]mulr_sumr -size_s.
rewrite le_eqVlt; apply/orP; left; apply/eqP; apply: sum_eq => j Hj.
rewrite margin_k // X_slip // [C * inner_product _ _ _]mulrC mulfK ?gt_eqF //.
have -> : \sum_(k <- si) `|X v (nf + k)%N| = (\sum_(k <- si) `|slide B v k|) / L.
  rewrite mulr_suml; apply: sum_eq => k Hk; rewrite X_slip // normrM [`|L^-1|]ger0_norm //.
  by rewrite invr_ge0 ltW.
move: (\sum_(k <- si) _) (Num.sqrt _) (cone_margin _ _ _ _) (slide _ _ _) (lt0r_neq0 LL0).
move=> S q m x l0.
by move: C L l0 (drift j) (slope j) => c' l' l0' dr sl; field.
Qed.

End Given.
