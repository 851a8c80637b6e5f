# What map_mpi_test.sh and batch_mpi_test.sh share: runs by 1, 2 and 4 ranks beside those of one process, byte for byte; and a run that
# loses a rank, twice, and is resumed. They are called with
#
#     PROGRAM MODELS FOLDER
#
# and end with 77 where there is no mpirun.
program=$1
models=$2
mkdir -p "$3"
cd "$3"
if ! command -v mpirun >/dev/null; then
    echo "SKIPPED: no mpirun; $program by several ranks is not tested" >&2
    exit 77
fi
# More ranks than processors, as root in containers, and without reading one another's memory, which containers forbid.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1
export OMPI_MCA_btl_vader_single_copy_mechanism=none OMPI_MCA_mpi_yield_when_idle=1 OMPI_MCA_plm_rsh_agent=false

# Each run keeps its session's files in a folder of its own: Open MPI else removes those of the run before while the next makes its own.
sessions=$(mktemp -d)
trap 'rm -rf "$sessions"' EXIT
new_session() {
    TMPDIR=$(mktemp -d "$sessions/XXXXXX")
    export TMPDIR
}

complain() {
    echo "FAILED: $*" >&2
    exit 1
}

# Of a kind; what follows is what stands behind the file's name.
same_for_any_number_of_ranks() {
    kind=$1
    shift
    "$program" --whole --kind "$kind" appendix "$models" "whole_$kind.npy" "$@" >report.txt
    for ranks in 1 2 4; do
        rm -f "$kind.npy" "$kind.npy.part" "$kind.npy.journal"
        new_session
        mpirun -n $ranks "$program" --kind "$kind" --tiles 100 appendix "$models" "$kind.npy" "$@" >report.txt
        cmp "$kind.npy" "whole_$kind.npy" || complain "$kind by $ranks ranks are not those of one process"
        [ ! -e "$kind.npy.part" ] && [ ! -e "$kind.npy.journal" ] || complain "something is left of a finished run"
        grep -q "of [0-9]* tiles computed by $ranks rank" report.txt || complain "no report: $(cat report.txt)"
    done
    echo "$kind: 1, 2 and 4 ranks write what one process does"
}

tiles_in_journal() { sed -n 's/^tile 0*\([0-9][0-9]*\)$/\1/p' lost.npy.journal; }

journal_length() { if [ -e lost.npy.journal ]; then stat -c %s lost.npy.journal; else echo 0; fi; }

process_of_rank() {
    for pid in $(pgrep -P $mpirun); do
        if tr '\0' '\n' <"/proc/$pid/environ" | grep -qx "OMPI_COMM_WORLD_RANK=$1"; then
            echo "$pid"
        fi
    done 2>/dev/null
}

still_runs() { kill -0 $mpirun 2>/dev/null || complain "the run was over before a rank could be killed: $(cat report.txt)"; }

# Kills a rank of so many with SIGKILL once some sixty tiles (a line has 16 bytes) are added to the journal.
# The process is looked for first: a busy machine may start it when others have long since begun.
lose() {
    length=$(journal_length)
    new_session
    mpirun -n "$2" "$program" $job >report.txt 2>&1 &
    mpirun=$!
    killed=
    while [ -z "$killed" ]; do
        still_runs
        killed=$(process_of_rank "$1")
    done
    while [ "$(journal_length)" -lt $((length + 60 * 16)) ]; do
        still_runs
        sleep 0.01
    done
    kill -9 "$killed"
    if wait $mpirun; then
        complain "the run did not notice that a rank was killed"
    fi
    [ ! -e lost.npy ] || complain "a lost run has left a file that looks finished"
    tiles_in_journal | sort >after.txt
    [ -z "$(uniq -d after.txt)" ] || complain "a tile is twice in the journal"
    echo "rank $1 of $2 killed: $(wc -l <after.txt) of 512 tiles are on disk"
}

# Distances of what is asked for, and not of another array whose journal would be taken for that.
a_lost_run_is_resumed() {
    job="--kind distances --tiles 512 --costs costs.csv appendix $models lost.npy $1"
    rm -f lost.npy* costs.csv
    "$program" --whole --kind distances appendix "$models" whole.npy $1 >report.txt
    lose 1 4
    cp after.txt first.txt
    new_session
    if mpirun -n 2 "$program" --kind distances --tiles 512 appendix "$models" lost.npy $2 >report.txt 2>&1; then
        complain "the journal of another array was taken"
    fi
    grep -q "belongs to another array" report.txt || complain "no word of another array: $(cat report.txt)"
    lose 0 3
    [ -z "$(comm -23 first.txt after.txt)" ] || complain "a tile was lost"
    # A line that the kill cut short.
    printf 'tile 00000' >>lost.npy.journal
    cp after.txt before.txt
    new_session
    mpirun -n 2 "$program" $job >report.txt
    grep -qx "resumed: $(wc -l <before.txt) of 512 tiles are on disk" report.txt || complain "not resumed: $(cat report.txt)"
    sed '1d; s/,.*//' costs.csv | sort >computed.txt
    [ -z "$(comm -12 before.txt computed.txt)" ] || complain "a tile was computed twice"
    [ "$(sort -u before.txt computed.txt | wc -l)" = 512 ] || complain "a tile was never computed"
    cmp lost.npy whole.npy || complain "the resumed array is not that of one process"
    echo "resumed: $(wc -l <computed.txt) tiles computed, none twice; the array is that of one process"
}
