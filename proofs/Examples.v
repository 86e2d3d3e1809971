(* Table 1 of the paper for k = m = 1, cos(phi) = 3/5, sin(phi) = 4/5, mu = 8, lambda^2 >= 0.

   Written by ./make-examples; `make examples` checks it.  [has_exactly]: exactly so many motions
   satisfy (9) with a value in the window, up to positive factors.  The check is evaluated by Coq's
   virtual machine; no extracted program takes part. *)

From Coq Require Import ZArith.
From mathcomp Require Import all_ssreflect all_algebra.
From Mceip Require Import Integers Sums Tree Enclosed Covered Definite Root RootLeaf Pinned Cover.
From Mceip Require Import Number Condensation Pencil Whole Claim Complete System.

Delimit Scope Z_scope with Z.

(* A list of so many motions with (9) in the window, no two the same, and every one is in it. *)
Definition has_exactly (R : rcfType) s u lo hi (count : nat) :=
  exists l : seq (R * (nat -> R)),
    [/\ size l = count,
        forall m, List.In m l -> satisfies_9 s u m.1 m.2 /\ between m.1 lo hi,
        List.ForallOrdPairs (fun m m' => ~ (m'.1 = m.1 /\ same_motion s m.2 m'.2)) l &
        forall t v, satisfies_9 s u t v -> between t lo hi ->
          exists2 m, List.In m l & t = m.1 /\ same_motion s m.2 v].

Lemma by_computation (R : rcfType) s u w tr lo hi count :
  [&& check_system s u [::] w tr lo hi, nilp (left_open tr lo hi) &
      omap size (solutions_found (pencil_of s u) [::] tr lo hi) == Some count] ->
  has_exactly R s u lo hi count.
Proof.
case/and3P=> checked /nilP closed.
case number: solutions_found => [ys|] //= /eqP[<-].
have [l [? ? _ ? every]] := system_exactly R checked number closed; exists l; split=> // t v sat bt.
by have [|[]] := every t v sat bt.
Qed.

Local Open Scope Z_scope.

(* Lists with natural numbers, written with integers. *)
Definition numbers (l : seq Z) : seq nat := [seq Z.to_nat i | i <- l].

Definition rows (l : seq (seq (Z * Z))) : seq sparse_row :=
  [seq [seq (Z.to_nat e.1, e.2) | e <- row] | row <- l].

Definition late (l : seq (Z * seq Z)) : seq late_row := [seq (Z.to_nat row.1, row.2) | row <- l].

(* T1.2 to T1.4: exactly three solutions *)
Module PlusMinus.

Definition body : system :=
  (System 4%nat (rows [:: [:: (0, 34); (1, (-12)); (2, (-25))]; [:: (0, (-12)); (1, 41)]; [:: (0,
(-25)); (2, 34); (3, 12)]; [:: (2, 12); (3, 41)]]) (rows [:: [:: (0, 25)]; [:: (1, 25)]; [:: (2,
25)]; [:: (3, 25)]]) (numbers [:: ]) [:: (SlipParticle 0%nat 1%nat (1, 0) (0, 1) 1); (SlipParticle
2%nat 3%nat (1, 0) (0, 1) (-1))] 1).

Definition asked : unknown :=
  (Lambda2 8 1).

Definition lo : point :=
  (0, 1).

Definition hi : point :=
  (1, 0).

Definition eliminated : elimination :=
  (Elimination [:: 25; 25] 72057594037927936 [:: [:: ]; [:: ]] [:: [:: ]; [:: ]] [:: [:: ]; [:: ]]
1 1 0 (late [:: ])).

Definition cover : tree (leaf whole) :=
  (Split (11, 64) (Leaf (Definite whole true (Factor [:: 1; 1] [:: [:: 4011796436689157120; 0]; [::
(-1617821635667259392); 3671125686298241024]]) (Factor [:: 1; 1] [:: [:: 30962263146723676160; 0];
[:: (-13415807065341757440); 27904799944677785600]]))) (Split (11, 32) (Leaf (Definite whole true
(Factor [:: 1; 1] [:: [:: 30962263146723676160; 0]; [:: (-13415807065341757440);
27904799944677785600]]) (Factor [:: 1; 1] [:: [:: 21062701592747896832; 0]; [::
(-9860647430570043392); 18611959344333881344]]))) (Split (9, 16) (Leaf (Definite whole true (Factor
[:: 1; 1] [:: [:: 21062701592747896832; 0]; [:: (-9860647430570043392); 18611959344333881344]])
(Factor [:: 1; 1] [:: [:: 14110445494964295680; 0]; [:: (-7359508047265896448);
12039199033514924032]]))) (Split (13, 16) (Leaf (Definite whole true (Factor [:: 1; 1] [:: [::
14110445494964295680; 0]; [:: (-7359508047265896448); 12039199033514924032]]) (Factor [:: 1; 1] [::
[:: 13158487144125394944; 0]; [:: (-7891935906709348352); 10529156260902627328]]))) (Split (9, 8)
(Leaf (Definite whole true (Factor [:: 1; 1] [:: [:: 13158487144125394944; 0]; [::
(-7891935906709348352); 10529156260902627328]]) (Factor [:: 1; 1] [:: [:: 8387406444837617664; 0];
[:: (-6190586914660187136); 5659083010783784960]]))) (Split (23, 16) (Leaf (Definite whole true
(Factor [:: 1; 1] [:: [:: 8387406444837617664; 0]; [:: (-6190586914660187136);
5659083010783784960]]) (Factor [:: 1; 1] [:: [:: 10404256992284510208; 0]; [::
(-9981100740562794496); 2937037890160416256]]))) (Split (15, 8) (Branch 1%nat (Leaf (Definite whole
true (Factor [:: 1] [:: [:: 10404256992284510208]]) (Factor [:: 1] [:: [:: 5604485226542781440]])))
(Branch 0%nat (Leaf (Definite whole true (Factor [:: 1] [:: [:: 10404256992284510208]]) (Factor [::
1] [:: [:: 5604485226542781440]]))) (Leaf (Root whole ((23, 16), (15, 8)) (Isolation 0%nat [::
72057594037927936; 72057594037927936] (1666331862126919, 1125899906842624) (3332663724254505,
2251799813685248) (Box [:: [:: 0; 0]; [:: 0; (-2239361951284923)]]
95780971304118053647396689196894323976171195136475136
47890485652059026823698344598447161988085597568237568 47045867181787661) (Box [:: [:: 0; 0]; [:: 0;
(-1844674407370959)]] 6739986666787659948666753771754907668409286105635143120275902562304
13479973333575319897333507543509815336818572211270286240551805124608 10815) (Uniqueness [:: [::
833201120258711; 1011473287112244]; [:: 1011473287112244; (-1011473287112244)]]
6901746346790563787434755862277025452451108972170386555162524223799296
3450873173395281893717377931138512726225554486085193277581262111899648 72057594037927936) [::
72057594037927936; 72057594037927936]) Solution)))) (Split (19, 8) (Branch 0%nat (Leaf (Definite
whole true (Factor [:: 1] [:: [:: 5604485226542781440]]) (Factor [:: 1] [:: [::
2334816161990365696]]))) (Branch 1%nat (Leaf (Definite whole true (Factor [:: 1] [:: [::
5604485226542781440]]) (Factor [:: 1] [:: [:: 2334816161990365696]]))) (Leaf (Farkas whole [::
(-256); (-256)])))) (Split (13, 4) (Branch 0%nat (Branch 1%nat (Leaf (Definite whole false (Factor
[:: ] [:: ]) (Factor [:: ] [:: ]))) (Leaf (Root whole ((19, 8), (13, 4)) (Isolation 1%nat [:: 0;
72057594037927936] (5584463537938865, 2251799813685248) (5584463537939981, 2251799813685248) (Box
[:: [:: 0; 0]; [:: 0; 0]] 9223372036854775808 4611686018427387904 0) (Box [:: [:: 0; 0]; [:: 0; 0]]
2596148429267413814265248164610048 2596148429267413814265248164610048 0) (Uniqueness [:: [:: 0; 0];
[:: 0; 1844674407370955]] 3450873173395281893717377931138512726225554486085193277581262111899648
1725436586697640946858688965569256363112777243042596638790631055949824 1) [:: 0;
72057594037927936]) Solution))) (Split (81, 32) (Branch 1%nat (Leaf (Root whole ((19, 8), (81, 32))
(Isolation 0%nat [:: 72057594037927936; 0] (5584463537938863, 2251799813685248) (5584463537939979,
2251799813685248) (Box [:: [:: 0; 0]; [:: 0; 0]] 9223372036854775808 36893488147419103232 0) (Box
[:: [:: 0; 0]; [:: 0; 0]] 2596148429267413814265248164610048 2596148429267413814265248164610048 0)
(Uniqueness [:: [:: 1844674407370955; 0]; [:: 0; 0]]
3450873173395281893717377931138512726225554486085193277581262111899648
13803492693581127574869511724554050904902217944340773110325048447598592 1) [:: 72057594037927936;
0]) Solution)) (Leaf (Farkas whole [:: (-256); (-256)]))) (Leaf (Farkas whole [:: (-256); 0]))))
(Split (17, 4) (Branch 0%nat (Leaf (Definite whole false (Factor [:: 1] [:: [::
4470832570234379776]]) (Factor [:: 1] [:: [:: 6778438759427824640]]))) (Leaf (Farkas whole [::
(-256); 0]))) (Split (11, 2) (Leaf (Definite whole false (Factor [:: 1; 1] [:: [::
6778438759427824640; 0]; [:: 3830009418697702400; 5592697011997011968]]) (Factor [:: 1; 1] [:: [::
6260824314561921024; 0]; [:: 2073327966757577216; 5907557214286684160]]))) (Split (15, 2) (Leaf
(Definite whole false (Factor [:: 1; 1] [:: [:: 6260824314561921024; 0]; [:: 2073327966757577216;
5907557214286684160]]) (Factor [:: 1; 1] [:: [:: 8071976786516090880; 0]; [:: 1608124315721629952;
7910167218664815616]]))) (Split (21, 2) (Leaf (Definite whole false (Factor [:: 1; 1] [:: [::
8071976786516090880; 0]; [:: 1608124315721629952; 7910167218664815616]]) (Factor [:: 1; 1] [:: [::
10202702654611763200; 0]; [:: 1272284666697563136; 10123064416732129280]]))) (Split (35, 2) (Leaf
(Definite whole false (Factor [:: 1; 1] [:: [:: 10202702654611763200; 0]; [:: 1272284666697563136;
10123064416732129280]]) (Factor [:: 1; 1] [:: [:: 13962494403339218944; 0]; [:: 929686470866741632;
13931508641535070208]]))) (Split (75, 2) (Leaf (Definite whole false (Factor [:: 1; 1] [:: [::
13962494403339218944; 0]; [:: 929686470866741632; 13931508641535070208]]) (Factor [:: 1; 1] [:: [::
21319946796503216128; 0]; [:: 608854340502674304; 21311251202071142400]]))) (Leaf (Definite whole
false (Factor [:: 1; 1] [:: [:: 21319946796503216128; 0]; [:: 608854340502674304;
21311251202071142400]]) (Factor [:: 1; 1] [:: [:: 2547493284792173568; 0]; [:: 0;
2547493284792173568]])))))))))))))))))).

Theorem exactly_3 (R : rcfType) : has_exactly R body asked lo hi 3.
Proof.
apply: (@by_computation _ _ _ eliminated cover); vm_cast_no_check (erefl true).
Qed.

End PlusMinus.

(* T1.1: exactly one solution *)
Module PlusPlus.

Definition body : system :=
  (System 4%nat (rows [:: [:: (0, 34); (1, (-12)); (2, (-25))]; [:: (0, (-12)); (1, 41)]; [:: (0,
(-25)); (2, 34); (3, 12)]; [:: (2, 12); (3, 41)]]) (rows [:: [:: (0, 25)]; [:: (1, 25)]; [:: (2,
25)]; [:: (3, 25)]]) (numbers [:: ]) [:: (SlipParticle 0%nat 1%nat (1, 0) (0, 1) 1); (SlipParticle
2%nat 3%nat (1, 0) (0, 1) 1)] 1).

Definition asked : unknown :=
  (Lambda2 8 1).

Definition lo : point :=
  (0, 1).

Definition hi : point :=
  (1, 0).

Definition eliminated : elimination :=
  (Elimination [:: 25; 10] 72057594037927936 [:: [:: ]; [:: ]] [:: [:: ]; [:: ]] [:: [:: ]; [:: ]]
1 1 0 (late [:: ])).

Definition cover : tree (leaf whole) :=
  (Split (11, 64) (Leaf (Farkas whole [:: 256; 0])) (Split (11, 32) (Leaf (Farkas whole [:: 256;
0])) (Split (9, 16) (Leaf (Farkas whole [:: 256; 0])) (Split (13, 16) (Leaf (Farkas whole [:: 256;
0])) (Split (9, 8) (Leaf (Farkas whole [:: 256; 0])) (Split (23, 16) (Leaf (Farkas whole [:: 256;
0])) (Split (15, 8) (Leaf (Farkas whole [:: 256; 0])) (Split (19, 8) (Leaf (Farkas whole [:: 256;
0])) (Split (13, 4) (Branch 1%nat (Leaf (Farkas whole [:: 0; 256])) (Branch 0%nat (Leaf (Definite
whole false (Factor [:: 1] [:: [:: 12542362702223370240]]) (Factor [:: 1] [:: [::
9367018838859440128]]))) (Leaf (Root whole ((19, 8), (13, 4)) (Isolation 0%nat [::
72057594037927936; 9228601975687560] (5872857349679065, 2251799813685248) (5872857349680239,
2251799813685248) (Box [:: [:: 0; 0]; [:: 0; 1151122875114481]]
95780971304118053647396689196894323976171195136475136
47890485652059026823698344598447161988085597568237568 782058436519070) (Box [:: [:: 0; 0]; [:: 0;
1181261052888008]] 26959946667150639794667015087019630673637144422540572481103610249216
26959946667150639794667015087019630673637144422540572481103610249216 309) (Uniqueness [:: [::
1815652835699379; 566506344992006]; [:: (-58043143343153); 1133012689984012]]
3450873173395281893717377931138512726225554486085193277581262111899648
1725436586697640946858688965569256363112777243042596638790631055949824 36028797018963968) [::
72057594037927936; 23071504939218904]) Solution)))) (Split (17, 4) (Leaf (Definite whole false
(Factor [:: 1; 1] [:: [:: 4470074711195346944; 0]; [:: (-4065488874124931072);
8438770179470114816]]) (Factor [:: 1; 1] [:: [:: 6778053832551833600; 0]; [::
(-2681158847927005184); 9536036095644162048]]))) (Split (11, 2) (Leaf (Definite whole false (Factor
[:: 1; 1] [:: [:: 6778053832551833600; 0]; [:: (-2681158847927005184); 9536036095644162048]])
(Factor [:: 1; 1] [:: [:: 6260693693537427456; 0]; [:: (-1451359856786392064);
7310648069411699712]]))) (Split (15, 2) (Leaf (Definite whole false (Factor [:: 1; 1] [:: [::
6260693693537427456; 0]; [:: (-1451359856786392064); 7310648069411699712]]) (Factor [:: 1; 1] [::
[:: 8071971962141701120; 0]; [:: (-1125687693794350336); 8041666686851794944]]))) (Split (21, 2)
(Leaf (Definite whole false (Factor [:: 1; 1] [:: [:: 8071971962141701120; 0]; [::
(-1125687693794350336); 8041666686851794944]]) (Factor [:: 1; 1] [:: [:: 10202702654611763200; 0];
[:: (-890599266688294144); 8984179599160387584]]))) (Split (35, 2) (Leaf (Definite whole false
(Factor [:: 1; 1] [:: [:: 10202702654611763200; 0]; [:: (-890599266688294144);
8984179599160387584]]) (Factor [:: 1; 1] [:: [:: 13962494403339218944; 0]; [::
(-650780529606719104); 10836149053806964736]]))) (Split (75, 2) (Leaf (Definite whole false (Factor
[:: 1; 1] [:: [:: 13962494403339218944; 0]; [:: (-650780529606719104); 10836149053806964736]])
(Factor [:: 1; 1] [:: [:: 21319946796503216128; 0]; [:: (-426198038351872000);
14882337603096688640]]))) (Leaf (Definite whole false (Factor [:: 1; 1] [:: [::
21319946796503216128; 0]; [:: (-426198038351872000); 14882337603096688640]]) (Factor [:: 1; 1] [::
[:: 2547493284792173568; 0]; [:: 0; 1611055365951182080]])))))))))))))))))).

Theorem exactly_1 (R : rcfType) : has_exactly R body asked lo hi 1.
Proof.
apply: (@by_computation _ _ _ eliminated cover); vm_cast_no_check (erefl true).
Qed.

End PlusPlus.

(* T1.6: exactly one solution *)
Module MinusMinus.

Definition body : system :=
  (System 4%nat (rows [:: [:: (0, 34); (1, (-12)); (2, (-25))]; [:: (0, (-12)); (1, 41)]; [:: (0,
(-25)); (2, 34); (3, 12)]; [:: (2, 12); (3, 41)]]) (rows [:: [:: (0, 25)]; [:: (1, 25)]; [:: (2,
25)]; [:: (3, 25)]]) (numbers [:: ]) [:: (SlipParticle 0%nat 1%nat (1, 0) (0, 1) (-1));
(SlipParticle 2%nat 3%nat (1, 0) (0, 1) (-1))] 1).

Definition asked : unknown :=
  (Lambda2 8 1).

Definition lo : point :=
  (0, 1).

Definition hi : point :=
  (1, 0).

Definition eliminated : elimination :=
  (Elimination [:: 10; 25] 72057594037927936 [:: [:: ]; [:: ]] [:: [:: ]; [:: ]] [:: [:: ]; [:: ]]
1 1 0 (late [:: ])).

Definition cover : tree (leaf whole) :=
  (Split (11, 64) (Leaf (Farkas whole [:: 0; 256])) (Split (11, 32) (Leaf (Farkas whole [:: 0;
256])) (Split (9, 16) (Leaf (Farkas whole [:: 0; 256])) (Split (13, 16) (Leaf (Farkas whole [:: 0;
256])) (Split (9, 8) (Leaf (Farkas whole [:: 0; 256])) (Split (23, 16) (Leaf (Farkas whole [:: 0;
256])) (Split (15, 8) (Leaf (Farkas whole [:: 0; 256])) (Split (19, 8) (Leaf (Farkas whole [:: 0;
256])) (Split (13, 4) (Branch 0%nat (Leaf (Farkas whole [:: 256; 0])) (Branch 1%nat (Leaf (Definite
whole false (Factor [:: 1] [:: [:: 12542362702223370240]]) (Factor [:: 1] [:: [::
9367018838859440128]]))) (Leaf (Root whole ((19, 8), (13, 4)) (Isolation 1%nat [::
9228601975687562; 72057594037927936] (5872857349679065, 2251799813685248) (5872857349680239,
2251799813685248) (Box [:: [:: 1151122875114481; 0]; [:: 0; 0]]
95780971304118053647396689196894323976171195136475136
47890485652059026823698344598447161988085597568237568 782058436519072) (Box [:: [::
1181261052888008; 0]; [:: 0; 0]]
26959946667150639794667015087019630673637144422540572481103610249216
26959946667150639794667015087019630673637144422540572481103610249216 310) (Uniqueness [:: [::
1133012689984012; (-58043143343153)]; [:: 566506344992006; 1815652835699379]]
3450873173395281893717377931138512726225554486085193277581262111899648
1725436586697640946858688965569256363112777243042596638790631055949824 36028797018963968) [::
23071504939218904; 72057594037927936]) Solution)))) (Split (17, 4) (Leaf (Definite whole false
(Factor [:: 1; 1] [:: [:: 9367018838859440128; 0]; [:: (-1940109155057993728);
4027101239120804864]]) (Factor [:: 1; 1] [:: [:: 9905786045804017664; 0]; [::
(-1834588282125253120); 6525051692673346560]]))) (Split (11, 2) (Leaf (Definite whole false (Factor
[:: 1; 1] [:: [:: 9905786045804017664; 0]; [:: (-1834588282125253120); 6525051692673346560]])
(Factor [:: 1; 1] [:: [:: 7453322791123702784; 0]; [:: (-1219123303401973760);
6140848792748570624]]))) (Split (15, 2) (Leaf (Definite whole false (Factor [:: 1; 1] [:: [::
7453322791123702784; 0]; [:: (-1219123303401973760); 6140848792748570624]]) (Factor [:: 1; 1] [::
[:: 8120072406474093568; 0]; [:: (-1119019517017029504); 7994030690342432768]]))) (Split (21, 2)
(Leaf (Definite whole false (Factor [:: 1; 1] [:: [:: 8120072406474093568; 0]; [::
(-1119019517017029504); 7994030690342432768]]) (Factor [:: 1; 1] [:: [:: 9028214115969748992; 0];
[:: (-1006458130668729344); 10152939647689861120]]))) (Split (35, 2) (Leaf (Definite whole false
(Factor [:: 1; 1] [:: [:: 9028214115969748992; 0]; [:: (-1006458130668729344);
10152939647689861120]]) (Factor [:: 1; 1] [:: [:: 10855673245544781824; 0]; [::
(-837029569415705984); 13937382518364153856]]))) (Split (75, 2) (Leaf (Definite whole false (Factor
[:: 1; 1] [:: [:: 10855673245544781824; 0]; [:: (-837029569415705984); 13937382518364153856]])
(Factor [:: 1; 1] [:: [:: 14888439048484589568; 0]; [:: (-610307062603773312);
21311209648798998528]]))) (Leaf (Definite whole false (Factor [:: 1; 1] [:: [::
14888439048484589568; 0]; [:: (-610307062603773312); 21311209648798998528]]) (Factor [:: 1; 1] [::
[:: 1611055365951182080; 0]; [:: 0; 2547493284792173568]])))))))))))))))))).

Theorem exactly_1 (R : rcfType) : has_exactly R body asked lo hi 1.
Proof.
apply: (@by_computation _ _ _ eliminated cover); vm_cast_no_check (erefl true).
Qed.

End MinusMinus.

(* T1.5: no solution *)
Module MinusPlus.

Definition body : system :=
  (System 4%nat (rows [:: [:: (0, 34); (1, (-12)); (2, (-25))]; [:: (0, (-12)); (1, 41)]; [:: (0,
(-25)); (2, 34); (3, 12)]; [:: (2, 12); (3, 41)]]) (rows [:: [:: (0, 25)]; [:: (1, 25)]; [:: (2,
25)]; [:: (3, 25)]]) (numbers [:: ]) [:: (SlipParticle 0%nat 1%nat (1, 0) (0, 1) (-1));
(SlipParticle 2%nat 3%nat (1, 0) (0, 1) 1)] 1).

Definition asked : unknown :=
  (Lambda2 8 1).

Definition lo : point :=
  (0, 1).

Definition hi : point :=
  (1, 0).

Definition eliminated : elimination :=
  (Elimination [:: 5; 5] 72057594037927936 [:: [:: ]; [:: ]] [:: [:: ]; [:: ]] [:: [:: ]; [:: ]] 1
1 0 (late [:: ])).

Definition cover : tree (leaf whole) :=
  (Leaf (Whole (WholeLeaf [:: ] false (WholeEnd 5192296858534827628530496329220096 (Late 1 (late
[:: (0, [:: 1161835695570046208; 0]); (0, [:: 223452286684446592; 1140145279811404160])])))
(WholeEnd 5192296858534827628530496329220096 (Late 1 (late [:: (0, [:: 509498656958434688; 0]); (1,
[:: 509498656958434688])])))))).

Theorem exactly_0 (R : rcfType) : has_exactly R body asked lo hi 0.
Proof.
apply: (@by_computation _ _ _ eliminated cover); vm_cast_no_check (erefl true).
Qed.

End MinusPlus.

(* spec/examples/two-particles-mu.json: exactly one mu >= 0 *)
Module InMu.

Definition body : system :=
  (System 4%nat (rows [:: [:: (0, 34); (1, (-12)); (2, (-25))]; [:: (0, (-12)); (1, 41)]; [:: (0,
(-25)); (2, 34); (3, 12)]; [:: (2, 12); (3, 41)]]) (rows [:: ]) (numbers [:: ]) [:: (SlipParticle
0%nat 1%nat (1, 0) (0, 1) 1); (SlipParticle 2%nat 3%nat (1, 0) (0, 1) 1)] 1).

Definition asked : unknown :=
  Mu.

Definition lo : point :=
  (0, 1).

Definition hi : point :=
  (1, 0).

Definition eliminated : elimination :=
  (Elimination [:: 25; 25] 72057594037927936 [:: [:: ]; [:: ]] [:: [:: ]; [:: ]] [:: [:: ]; [:: ]]
1 1 0 (late [:: ])).

Definition cover : tree (leaf whole) :=
  (Split (13, 64) (Leaf (Definite whole false (Factor [:: 1; 1] [:: [:: 2970862159212920320; 0];
[:: (-2184675937603260672); 2013259301903400960]]) (Factor [:: 1; 1] [:: [:: 22898939725031964672;
0]; [:: (-18139868206592538624); 16622468317648963584]]))) (Split (13, 32) (Leaf (Definite whole
false (Factor [:: 1; 1] [:: [:: 22898939725031964672; 0]; [:: (-18139868206592538624);
16622468317648963584]]) (Factor [:: 1; 1] [:: [:: 15554058554642993152; 0]; [::
(-13352905520559175680); 12026158267436300288]]))) (Split (11, 16) (Leaf (Definite whole false
(Factor [:: 1; 1] [:: [:: 15554058554642993152; 0]; [:: (-13352905520559175680);
12026158267436300288]]) (Factor [:: 1; 1] [:: [:: 10341361869813647360; 0]; [::
(-10041804791090622464); 8639689831974568960]]))) (Split (15, 16) (Leaf (Definite whole false
(Factor [:: 1; 1] [:: [:: 10341361869813647360; 0]; [:: (-10041804791090622464);
8639689831974568960]]) (Factor [:: 1; 1] [:: [:: 9720134089131999232; 0]; [::
(-10683591010005286912); 8590880821852149760]]))) (Split (21, 16) (Leaf (Definite whole false
(Factor [:: 1; 1] [:: [:: 9720134089131999232; 0]; [:: (-10683591010005286912);
8590880821852149760]]) (Factor [:: 1; 1] [:: [:: 8705565391926679552; 0]; [::
(-11928683835630094336); 8021175199293832192]]))) (Split (13, 8) (Leaf (Definite whole false
(Factor [:: 1; 1] [:: [:: 8705565391926679552; 0]; [:: (-11928683835630094336);
8021175199293832192]]) (Factor [:: 1; 1] [:: [:: 5486730380128473088; 0]; [::
(-9463371623544674304); 4642051138457814016]]))) (Split (9, 4) (Branch 1%nat (Leaf (Definite whole
false (Factor [:: 1] [:: [:: 5487468473469715456]]) (Factor [:: 1] [:: [:: 2696013479266853376]])))
(Branch 0%nat (Leaf (Definite whole false (Factor [:: 1] [:: [:: 10540590175951632384]]) (Factor
[:: 1] [:: [:: 7958623440768980992]]))) (Leaf (Root whole ((13, 8), (9, 4)) (Isolation 0%nat [::
72057594037927936; 31580142046053292] (8648201281969019, 4503599627370496) (8648201281970749,
4503599627370496) (Box [:: [:: 0; 0]; [:: 0; 1611069351415681]]
95780971304118053647396689196894323976171195136475136
47890485652059026823698344598447161988085597568237568 2335491847870138) (Box [:: [:: 0; 0]; [:: 0;
1616903272757929]] 53919893334301279589334030174039261347274288845081144962207220498432
53919893334301279589334030174039261347274288845081144962207220498432 1281) (Uniqueness [:: [::
(-2376317971789790); (-1037693437462790)]; [:: 873181691094487; 1992371399928558]]
1725436586697640946858688965569256363112777243042596638790631055949824
862718293348820473429344482784628181556388621521298319395315527974912 18014398509481984) [::
72057594037927936; 31580142046053292]) Solution)))) (Split (11, 4) (Leaf (Farkas whole [:: 256;
84])) (Split (15, 4) (Leaf (Farkas whole [:: 256; 21])) (Split (9, 2) (Leaf (Farkas whole [:: 256;
0])) (Split (13, 2) (Leaf (Farkas whole [:: 256; 0])) (Split (17, 2) (Leaf (Farkas whole [:: 256;
0])) (Split (25, 2) (Leaf (Farkas whole [:: 256; 0])) (Split (39, 2) (Leaf (Farkas whole [:: 256;
0])) (Split (85, 2) (Leaf (Farkas whole [:: 256; 0])) (Leaf (Farkas whole [:: 256;
0]))))))))))))))))).

Theorem exactly_1 (R : rcfType) : has_exactly R body asked lo hi 1.
Proof.
apply: (@by_computation _ _ _ eliminated cover); vm_cast_no_check (erefl true).
Qed.

End InMu.
