(* The conditions (9) of System.v are those of Reduction.v.

   System.v has them for sparse rows, vectors v over the degrees of freedom and a tangent and a
   normal for each particle; Reduction.v for a matrix in blocks, free (f), tangential (Ts), normal
   (Ns) and at rest (d).  [basis] has a vector over the degrees of freedom for each coordinate of
   the blocks, and [block_matrix] is K + lambda^2 M in this basis, b_i'(K + lambda^2 M) b_j.

   Theorem [same_conditions]: v satisfies (9) of System.v if and only if it has coordinates that
   satisfy (9) of Reduction.v.  The friction factors are 1 there: the normal of a particle has its
   factor as its length; the geometric stiffnesses are those that give the same
   (1 + c^2 mu^2) g. *)

From Mceip Require Import Base Integers Sums Tree System.
From Mceip Require Reduction.

Section Same.

Variables (R : rcfType) (s : system) (lambda2 mu : R).
Hypothesis wf : system_wellformed s (Lambda2 0 1).

Notation nf := (free_number s).
Notation ns := (size (particles s)).
Notation all_dofs := (iota 0 (dofs s)).

Definition resting_dofs := [seq d <- all_dofs | d \notin moving_dofs s].
Notation nd := (size resting_dofs).
Notation coordinate := 'I_(nf + (ns + (ns + nd))).

Definition unit_at (c d : nat) : R := (d == c)%:R.

(* A vector over the two degrees of freedom of a particle. *)
Definition direction_of (e : planar) p d : R :=
  toR e.1 * unit_at (first_dof p) d + toR e.2 * unit_at (second_dof p) d.

Definition basis (k : coordinate) (d : nat) : R :=
  match split k with
  | inl i => toR (unit_length s) * unit_at (nth 0%N (free_dofs s) i) d
  | inr k => match split k with
    | inl j => direction_of (tangent (particle s j)) (particle s j) d
    | inr k => match split k with
      | inl j => direction_of (normal (particle s j)) (particle s j) d
      | inr i => unit_at (nth 0%N resting_dofs i) d
      end
    end
  end.

Definition combined (q : 'cV[R]_(nf + (ns + (ns + nd)))) (d : nat) := \sum_k q k 0 * basis k d.

(* b_k'f *)
Definition along_basis (f : nat -> R) k := \sum_(d <- all_dofs) basis k d * f d.

Definition block_matrix : 'M[R]_(nf + (ns + (ns + nd))) :=
  \matrix_(i, j) along_basis (force s lambda2 (basis j)) i.

Definition sign (j : 'I_ns) : R := toR (sign_of (particle s j)).

Definition geometric (j : 'I_ns) : R :=
  toR (unit_length s) ^+ 2 * turning_at s mu (particle s j) / (1 + mu ^+ 2).

Lemma sign_squared j : sign j * sign j = 1.
Proof. by have [<- _ _ _] := particle_parts R wf (ltn_ord j); rewrite expr2. Qed.

Lemma force_combined q d :
  force s lambda2 (combined q) d = \sum_j force s lambda2 (basis j) d * q j 0.
Proof.
rewrite /force; under [RHS]eq_bigr => j _ do rewrite mulr_suml.
rewrite exchange_big /=; apply: eq_bigr => e _; rewrite /combined mulr_sumr.
by apply: eq_bigr => j _; rewrite mulrA mulrAC.
Qed.

Lemma block_product q k : (block_matrix *m q) k 0 = along_basis (force s lambda2 (combined q)) k.
Proof.
rewrite mxE; under eq_bigr => j _ do rewrite mxE /along_basis mulr_suml.
rewrite exchange_big /=; apply: eq_bigr => d _; rewrite force_combined mulr_sumr.
by apply: eq_bigr => j _; rewrite mulrA.
Qed.

(* The coordinates of b_k'f. *)
Lemma sum_unit c f : c \in all_dofs -> \sum_(d <- all_dofs) unit_at c d * f d = f c.
Proof.
move=> c_in; rewrite (bigD1_seq c) ?iota_uniq //= /unit_at eqxx mul1r big1 ?addr0 //.
by move=> d /negbTE->; rewrite mul0r.
Qed.

Lemma sum_direction e j f : (j < ns)%N -> let p := particle s j in
  \sum_(d <- all_dofs) direction_of e p d * f d = along e p f.
Proof.
move=> lt_j p; under eq_bigr => d _ do rewrite mulrDl -!mulrA.
by rewrite big_split /= -!mulr_sumr !sum_unit ?(first_dof_in wf) ?(second_dof_in wf).
Qed.

Notation free_at i := (lshift (ns + (ns + nd)) i).
Notation tangent_at j := (rshift nf (lshift (ns + nd) j)).
Notation normal_at j := (rshift nf (rshift ns (lshift nd j))).
Notation rest_at i := (rshift nf (rshift ns (rshift ns i))).

Lemma basis_free i d :
  basis (free_at i) d = toR (unit_length s) * unit_at (nth 0%N (free_dofs s) i) d.
Proof. by rewrite /basis (unsplitK (inl _ i)). Qed.

Lemma basis_tangent j d :
  basis (tangent_at j) d = direction_of (tangent (particle s j)) (particle s j) d.
Proof. by rewrite /basis (unsplitK (inr _ _)) (unsplitK (inl _ j)). Qed.

Lemma basis_normal j d :
  basis (normal_at j) d = direction_of (normal (particle s j)) (particle s j) d.
Proof. by rewrite /basis !(unsplitK (inr _ _)) (unsplitK (inl _ j)). Qed.

Lemma along_free f (i : 'I_nf) :
  along_basis f (free_at i) = toR (unit_length s) * f (nth 0%N (free_dofs s) i).
Proof.
rewrite /along_basis; under eq_bigr => d _ do rewrite basis_free -mulrA.
by rewrite -mulr_sumr sum_unit // (free_dof_in wf).
Qed.

Lemma along_tangent_at f (j : 'I_ns) :
  along_basis f (tangent_at j) = along (tangent (particle s j)) (particle s j) f.
Proof. by rewrite -sum_direction //; apply: eq_bigr => d _; rewrite basis_tangent. Qed.

Lemma along_normal_at f (j : 'I_ns) :
  along_basis f (normal_at j) = along (normal (particle s j)) (particle s j) f.
Proof. by rewrite -sum_direction //; apply: eq_bigr => d _; rewrite basis_normal. Qed.

Section Motion.

(* The motion of x, as coordinates and as a vector. *)
Variable x : nat -> R.
Notation X := (\col_(i < nf + ns) x i).
Notation q := (@Reduction.motion R nf ns nd sign X).

Lemma coordinates :
  [/\ forall i, q (free_at i) 0 = x i, forall j, q (tangent_at j) 0 = - (sign j * x (nf + j)%N),
      forall j, q (normal_at j) 0 = 0 & forall i, q (rest_at i) 0 = 0].
Proof.
split=> i; rewrite /Reduction.motion.
- by rewrite col_mxEu !mxE.
- by rewrite col_mxEd col_mxEu mxE Reduction.S_mul !mxE.
- by rewrite !col_mxEd col_mxEu mxE.
by rewrite !col_mxEd mxE.
Qed.

Lemma sum_listed (l : seq nat) (F : nat -> R) d n : uniq l -> size l = n ->
  \sum_(i < n) F i * unit_at (nth 0%N l i) d = if d \in l then F (index d l) else 0.
Proof.
move=> u <-; case: ifP => [d_in|/negbT out]; last first.
  rewrite big1 // => i _; rewrite /unit_at; case: eqP => [eq|]; last by rewrite mulr0.
  by case/negP: out; rewrite eq mem_nth.
have lt := d_in; rewrite -index_mem in lt.
rewrite (bigD1 (Ordinal lt)) //= /unit_at nth_index // eqxx mulr1 big1 ?addr0 // => i ne.
case: eqP => [eq|]; last by rewrite mulr0.
by case/negP: ne; apply/eqP/val_inj; rewrite /= eq index_uniq.
Qed.

Lemma combined_motion d : combined q d = motion s x d.
Proof.
have [qf qt qn qr] := coordinates; have [uf u1 u2 out1 out2] := uniq_parts wf.
rewrite /combined !big_split_ord /=.
under eq_bigr => i _ do rewrite qf basis_free mulrA.
under [X in _ + (X + _)]eq_bigr => j _ do
  rewrite qt basis_tangent /direction_of first_particle // second_particle // mulrDr !mulrA.
rewrite [X in _ + (_ + (X + _))]big1 => [|j _]; last by rewrite qn mul0r.
rewrite [X in _ + (_ + (_ + X))]big1 => [|j _]; last by rewrite qr mul0r.
rewrite big_split /= !addr0.
rewrite (sum_listed (fun i => x i * toR (unit_length s))) //.
rewrite (sum_listed (fun j => - (toR (sign_of (particle s j)) * x (nf + j)%N) *
  toR (tangent (particle s j)).1)) ?size_map //.
rewrite (sum_listed (fun j => - (toR (sign_of (particle s j)) * x (nf + j)%N) *
  toR (tangent (particle s j)).2)) ?size_map //.
rewrite /motion /column; case: ifP => [d_f|_].
  have [in1|_] := boolP (d \in first_dofs s); first by rewrite out1 in d_f.
  have [in2|_] := boolP (d \in second_dofs s); last by rewrite !addr0 mulrC.
  by have := out2 _ in2; rewrite d_f.
case: ifP => [d_1|_].
  have [in2|_] := boolP (d \in second_dofs s); last first.
    by rewrite add0r addr0 toRN toRM; ring.
  by have := out2 _ in2; rewrite d_1 orbT.
by case: ifP => _; rewrite !add0r // toRN toRM; ring.
Qed.

Lemma column_nonzero : X != 0 <-> exists2 i, i \in iota 0 (nf + ns) & x i != 0.
Proof.
split=> [|[i]]; last first.
  rewrite mem_iota => lt_i; apply: contraNneq => /colP/(_ (Ordinal lt_i)).
  by rewrite !mxE => /eqP.
have [i xi _|none] := pickP (fun i => X i 0 != 0).
  by exists (val i); [rewrite mem_iota ltn_ord|move: xi; rewrite mxE].
by case/eqP; apply/colP=> i; have /negbFE/eqP-> := none i; rewrite mxE.
Qed.

Lemma same_motion :
  Reduction.conditions_9 block_matrix sign (fun=> 1) geometric mu q (block_matrix *m q) <->
  conditions_9 s lambda2 mu (motion s x).
Proof.
have [qf qt qn qr] := coordinates; have l0 := unit_length_gt0 R wf.
have l2 : 0 < toR (unit_length s) ^+ 2 :> R by rewrite exprn_gt0.
have wE k : (block_matrix *m q) k 0 = along_basis (force s lambda2 (motion s x)) k.
  rewrite block_product; apply: eq_bigr => d _; congr (_ * _).
  by apply: eq_bigr => e _; rewrite combined_motion.
have nonzeroE : q != 0 <-> exists2 d, d \in all_dofs & motion s x d != 0.
  rewrite (Reduction.motion_zero nd sign_squared).
  by split=> [/column_nonzero/(motion_nonzero wf)|/(motion_nonzero wf)/column_nonzero].
rewrite /Reduction.conditions_9; move: (block_matrix *m q) wE => W wE.

have rate (j : 'I_ns) : slip_rate (motion s x) (particle s j) =
    toR (unit_length s) ^+ 2 * (sign j * usubmx (dsubmx q) j 0).
  rewrite (slip_motion wf) // [usubmx _ _ _]mxE [dsubmx _ _ _]mxE qt.
  by rewrite mulrN mulrA sign_squared mul1r mulrN.
have coneE (j : 'I_ns) : cone s lambda2 mu (motion s x) (particle s j) =
    Reduction.cone sign (fun=> 1) geometric mu q W j.
  have mu2 : 1 + mu ^+ 2 != 0 by rewrite gt_eqF // ltr_paddr ?ltr01 // sqr_ge0.
  rewrite /cone /Reduction.cone; congr (_ + _); last first.
    by rewrite rate /Reduction.turning /geometric; field.
  by rewrite !mxE !wE along_tangent_at along_normal_at mul1r.

split=> [[nonzero _ free _ slips]|[nonzero _ free slips]].
  split=> //; first exact/nonzeroE.
    by move=> d _; apply: motion_zero.
    move=> d /(nthP 0%N)[k lt_k <-]; move/colP/(_ (Ordinal lt_k)): free.
    by rewrite !mxE wE along_free => /eqP; rewrite mulf_eq0 gt_eqF //= => /eqP.
  move=> j lt_j p; have [a b c] := slips (Ordinal lt_j).
  rewrite (rate (Ordinal lt_j)) (coneE (Ordinal lt_j)); split=> //.
  - exact: (normal_motion wf x lt_j).
  - by rewrite pmulr_rle0.
  by rewrite mulrCA c mulr0.
split=> //; first exact/nonzeroE.
- by apply/colP=> i; rewrite !mxE wE along_free free ?mulr0 // mem_nth.
- split; apply/colP=> i; last by rewrite ![dsubmx _ _ _]mxE qr mxE.
  by rewrite [usubmx _ _ _]mxE ![dsubmx _ _ _]mxE qn mxE.
move=> j; have [_ a b c] := slips _ (ltn_ord j).
move: a b c; rewrite rate coneE pmulr_rle0 // => a b c; split=> //.
by apply: (mulfI (lt0r_neq0 l2)); rewrite mulr0 -c mulrCA.
Qed.

End Motion.

Theorem same_conditions v : conditions_9 s lambda2 mu v <-> exists q w,
  Reduction.conditions_9 block_matrix sign (fun=> 1) geometric mu q w /\
  forall d, d \in all_dofs -> v d = combined q d.
Proof.
split=> [sat|[q [w [sat same]]]].
  have moves := motion_of_variables wf sat; set x := variables_of s v in moves.
  pose q := Reduction.motion nd sign (\col_(i < nf + ns) x i); exists q, (block_matrix *m q).
  split; last by move=> d d_in; rewrite combined_motion moves.
  by apply/same_motion; apply: (conditions_9_ext wf) sat => d d_in; rewrite moves.
have [X qE] := Reduction.reduction_onto sign_squared sat.
have wE : w = block_matrix *m q by case: sat => _ <-.
pose x k := if insub k is Some i then X i 0 else 0.
have XE : X = \col_i x i by apply/colP=> i; rewrite mxE /x valK.
have : conditions_9 s lambda2 mu (motion s x) by apply/same_motion; rewrite -XE -qE -wE.
by apply: (conditions_9_ext wf) => d d_in; rewrite same // qE XE combined_motion.
Qed.

End Same.
