(* Members of lists of things whose equality is not decided.

   Page: none; mathcomp's lists, and [List.In] of Coq's library. *)

From Mceip Require Import Base.

Section Lists.

Variables T U : Type.

Lemma in_cat_or (x : T) (a b : seq T) : List.In x (a ++ b) <-> List.In x a \/ List.In x b.
Proof. exact: List.in_app_iff. Qed.

Lemma in_filter (p : T -> bool) l x : List.In x (filter p l) <-> List.In x l /\ p x.
Proof. exact: List.filter_In. Qed.

Lemma all_In (p : T -> bool) (l : seq T) x : all p l -> List.In x l -> p x.
Proof. by move/(List.forallb_forall p l)/(_ x). Qed.

Lemma has_In (p : T -> bool) l : has p l -> exists2 x, List.In x l & p x.
Proof. by move/(List.existsb_exists p l) => [x [xl px]]; exists x. Qed.

Lemma in_pmap (f : T -> option U) (l : seq T) y :
  List.In y (pmap f l) <-> exists2 x, List.In x l & f x = Some y.
Proof.
elim: l => [|a l IH] /=; first by split=> [|[]].
case fa: (f a) => [b|] /=; rewrite ?IH; split=> [|[x [<-|xl] fx]].
- by case=> [<-|[x xl fx]]; [exists a | exists x]; auto.
- by left; case: (etrans (esym fa) fx).
- by right; exists x.
- by case=> x xl fx; exists x; auto.
- by rewrite fx in fa.
by exists x.
Qed.

Lemma in_flatten_map (f : T -> seq U) l y :
  List.In y (flatten (map f l)) <-> exists2 x, List.In x l & List.In y (f x).
Proof.
elim: l => [|a l IH] /=; first by split=> [|[]].
rewrite List.in_app_iff IH; split=> [[yf|[x xl yf]]|[x [<-|xl] yf]].
- by exists a => //; left.
- by exists x => //; right.
- by left.
by right; exists x.
Qed.

Lemma in_zip (rs : seq T) (ls : seq U) r : size rs = size ls -> List.In r rs ->
  exists l, List.In (r, l) (zip rs ls).
Proof.
elim: rs ls => //= a rs IH [|b ls] //= [sz] [<-|/(IH _ sz)[l rl]].
  by exists b; left.
by exists l; right.
Qed.

Lemma Forall2_in (p : T -> U -> Prop) ys l : List.Forall2 p ys l ->
  forall s, List.In s l -> exists2 y, List.In y ys & p y s.
Proof.
elim=> // y s ys' l' ps _ IH s' /= [<-|/IH[z zl pz]]; first by exists y => //; left.
by exists z => //; right.
Qed.

End Lists.
