#!/bin/sh
#SBATCH --job-name=mceip-merge --time=60
# The parts joined and checked. It refuses a whole with a piece that no part has searched (exit 2), and one with
# regions left open is UNDECIDED (exit 3): it may run after any end of the parts.
mceip merge --problem problem.json part-*.json --certificate whole.json && mceip check problem.json whole.json
