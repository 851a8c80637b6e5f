#!/bin/sh
# Batches by several ranks: batch_mpi_test.sh BATCH_MPI MODELS FOLDER
set -eu
. "$(dirname "$0")/tile_run_test.sh"

# Of the configurations in a file, which several ranks have written.
files_say_what_seeds_do() {
    "$program" --kind distances appendix "$models" seeded.npy 5000 >report.txt
    rm -f configurations.npy
    mpirun -n 4 "$program" --kind configurations appendix "$models" configurations.npy 5000 >report.txt
    mpirun -n 2 "$program" --kind distances appendix "$models" read.npy configurations.npy >report.txt
    cmp seeded.npy read.npy || complain "the configurations of a file are others than were written"
    echo "configurations of a file: as they were written"
}

# The first coordinate of number 700 of the classes asked becomes a NaN: its class, and no other, becomes 255 (377 in octal digits).
a_failure_is_of_one_item() {
    "$program" appendix "$models" before.npy configurations.npy >report.txt
    printf '\000\000\000\000\000\000\370\177' | dd of=configurations.npy bs=1 seek=$((128 + 700 * 24)) conv=notrunc 2>/dev/null
    mpirun -n 2 "$program" appendix "$models" after.npy configurations.npy >report.txt
    cmp -l before.npy after.npy >differing.txt || true
    [ "$(awk '{ print $1, $3 }' differing.txt)" = "$((128 + 700 + 1)) 377" ] || complain "a NaN among configurations: $(cat differing.txt)"
    grep -q "4999 answers, 1 failures" report.txt || complain "no word of the failure: $(cat report.txt)"
    echo "a configuration with a NaN: fails alone"
}

other_files_are_refused() {
    head -c 5000 configurations.npy >short.npy
    for file in short.npy before.npy "$program.npy"; do
        if "$program" appendix "$models" refused.npy "$file" >report.txt 2>&1; then
            complain "$file was taken for configurations"
        fi
        grep -q "$file" report.txt || complain "no word of $file: $(cat report.txt)"
    done
    [ ! -e refused.npy ] || complain "something was written"
    echo "files with other contents: refused"
}

same_for_any_number_of_ranks classes 20000
same_for_any_number_of_ranks distances 10001
same_for_any_number_of_ranks motions 1000
same_for_any_number_of_ranks configurations 777
files_say_what_seeds_do
a_failure_is_of_one_item
other_files_are_refused
a_lost_run_is_resumed 1000000 1000001
