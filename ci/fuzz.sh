#!/usr/bin/env bash
# Fuzzes one target (read, interpret, macros, tape, compensation) for FUZZ_SECONDS (60), or with FUZZ_RUNS inputs, each of up to FUZZ_LENGTH (256)
# bytes, with libFuzzer; a finding stays in fuzz/artifacts/.
# Runs on the stable compiler; the C++ part of libFuzzer needs a C++ compiler.
set -euo pipefail
cd "$(dirname "$0")/../fuzz"
target=$1
corpus=corpus/$target
command -v c++ >/dev/null || { echo "make fuzz needs a C++ compiler (Debian: apt-get install g++)"; exit 1; }

cargo build --release --locked --quiet --bin "$target"

# Every program of the corpus and of the examples is a seed; their names are those of their contents. A first byte of 0 to 7
# chooses the control: each program is a seed for four.
mkdir -p "$corpus" artifacts
controls=('')
[ "$target" != interpret ] || controls=('\000' '\001' '\002' '\003')
find ../cases ../examples -type f \( -name '*.nc' -o -name '*.cnc' -o -name '*.txt' -o -name '*.eia' -o -name '*.iso' \) -size -4k | while read -r seed; do
    name=$(cksum <"$seed" | cut -d' ' -f1)
    for control in "${controls[@]}"; do
        { printf %b "$control"; cat "$seed"; } >"$corpus/$name${control#??}"
    done
done

host=$(rustc -vV | sed -n "s/^host: //p")
built=${CARGO_TARGET_DIR:-target}/$host/release/$target
log=artifacts/$target.log
limit=(-max_total_time="${FUZZ_SECONDS:-60}")
[ -z "${FUZZ_RUNS:-}" ] || limit=(-runs="$FUZZ_RUNS")
if "$built" -max_len="${FUZZ_LENGTH:-256}" -timeout=10 "${limit[@]}" -print_final_stats=1 -dict=words.dict \
    -artifact_prefix="artifacts/$target-" "$corpus" >"$log" 2>&1; then
    runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
    rate=$(sed -n 's/^stat::average_exec_per_sec: *//p' "$log")
    echo "fuzz $target: $runs programs of up to ${FUZZ_LENGTH:-256} bytes, $rate a second, nothing found"
else
    grep -m1 -A4 -E 'panicked|ERROR' "$log" || true
    echo "fuzz $target: found something; the input is the newest file fuzz/artifacts/$target-*, all output is in fuzz/$log"
    exit 1
fi
