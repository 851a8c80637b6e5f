#!/bin/sh
# Maps by several ranks: map_mpi_test.sh MAP_MPI MODELS FOLDER
set -eu
. "$(dirname "$0")/tile_run_test.sh"

same_for_any_number_of_ranks classes 60 50 20
same_for_any_number_of_ranks distances 30 25 20
same_for_any_number_of_ranks cells 40 30
a_lost_run_is_resumed "192 96 48" "192 96 49"
