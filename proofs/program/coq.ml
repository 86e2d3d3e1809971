(* What the kernel proved as a Coq file, in which Coq's own evaluation repeats it (Evaluated.v).

   Coq proves a theorem about the term [given].  That this is the problem of the file is for a reader
   to see, or rests on what reads and prints it. *)

let define name kind value = Printf.printf "Definition %s : %s :=\n  %s.\n\n" name kind value

let theorem name says proof =
  Printf.printf "Theorem %s (R : rcfType) : %s.\nProof. %s. Qed.\n\n" name says proof

let print_part part (evidence, (statement : Kernel.statement)) =
  let name word = word ^ "_" ^ part in
  define (name "shown") "evidence" (Terms.of_evidence evidence);
  define (name "said") "statement" (Terms.of_statement statement);
  theorem (name "holds") ("meaning R given " ^ name "said") ("by_evaluation factors " ^ name "shown");
  match statement with
  | AllInWindow (lo, hi, { solutions_in; families_of_set = []; open_regions = [] }) ->
    let window = Terms.of_point lo ^ " " ^ Terms.of_point hi in
    theorem (name "exactly")
      (Printf.sprintf "exactly R given %s %d" window (List.length solutions_in))
      (Printf.sprintf "exact: (number_of_solutions (@%s R))" (name "holds"))
  | _ -> ()

let print problem digest scales parts =
  Printf.printf "(* mceip-verified --coq, problem %s *)\n\n" digest;
  print_string "From Mceip Require Import Evaluated.\nLocal Open Scope Z_scope.\n\n";
  define "given" "problem" (Terms.of_problem problem);
  define "factors" "scales" (Terms.of_scales scales);
  List.iteri (fun place -> print_part (string_of_int (place + 1))) parts
