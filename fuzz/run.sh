#!/bin/sh
# Builds every target in fuzz_targets with the stable compiler and lets each run for SECONDS on its seeds.
# Usage: fuzz/run.sh [SECONDS] [TARGET...]; fails on the first crash, the input is then in fuzz/artifacts/TARGET.
set -eu
cd "$(dirname "$0")"

seconds=${1:-10}
[ $# -gt 0 ] && shift
[ $# -gt 0 ] || set -- $(ls fuzz_targets | sed 's/\.rs$//')

features=
case " $* " in *" picture "*) features="--features picture" ;; esac

# What `cargo fuzz` passes to a nightly compiler, less the address sanitizer, which stable does not have.
host=$(rustc -vV | sed -n 's/^host: //p')
coverage="-Cpasses=sancov-module -Cllvm-args=-sanitizer-coverage-level=4"
coverage="$coverage -Cllvm-args=-sanitizer-coverage-inline-8bit-counters"
coverage="$coverage -Cllvm-args=-sanitizer-coverage-pc-table -Cllvm-args=-sanitizer-coverage-trace-compares"
RUSTFLAGS="$coverage -Ccodegen-units=1 --cfg fuzzing" cargo build --release --target "$host" --bins $features

for target; do
    mkdir -p "corpus/$target" "artifacts/$target"
    echo "fuzzing $target for $seconds s"
    "${CARGO_TARGET_DIR:-target}/$host/release/$target" "corpus/$target" "seeds/$target" \
        -max_total_time="$seconds" -timeout=10 -rss_limit_mb=2048 -max_len=65536 \
        -artifact_prefix="artifacts/$target/" -verbosity=0 -print_final_stats=1
done
