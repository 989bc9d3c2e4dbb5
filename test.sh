#!/usr/bin/env bash
# Runs every check of Penstemon on a fresh clone: formatting, lints, tests, other systems, third-party judges.
#
#   ./test.sh [--fuzz] [--nightly]
#
# --fuzz also looks for new inputs that break a reader, FUZZ_SECONDS (8) a reader; their seeds are replayed by the tests in any
# case. --nightly fuzzes too, pictures among the readers, 60 s each.
#
# Installs the system packages the checks need. What cannot run on this machine is counted and named at the end, after the
# seconds and the seconds of processor time that each check took.
set -uo pipefail
cd "$(dirname "$0")"

fuzz=false
nightly=false
for argument; do
    case $argument in
        --fuzz) fuzz=true ;;
        --nightly) fuzz=true nightly=true FUZZ_SECONDS=${FUZZ_SECONDS:-60} ;;
        *)
            echo "test.sh: unknown argument $argument; there are --fuzz and --nightly" >&2
            exit 2
            ;;
    esac
done

. scripts/packages.sh
need cc gcc gcc gcc
need c++ g++ gcc-c++ gcc
need git git git git
need python3 python3 python3 python
need '/usr/lib/python3*/ensurepip' python3-venv python3 python
need node nodejs nodejs nodejs
need npm npm npm npm
need '/usr/share/vulkan/icd.d/lvp_icd*' mesa-vulkan-drivers mesa-vulkan-drivers vulkan-swrast
need '/usr/lib*/*/libvulkan.so.1' libvulkan1 vulkan-loader vulkan-icd-loader
# Other programs that draw and rewrite our SVG files.
need rsvg-convert librsvg2-bin librsvg2-tools librsvg
need scour scour scour scour
# What the window's tests use, and what the window loads when it opens.
need Xvfb xvfb xorg-x11-server-Xvfb xorg-server-xvfb
need xdotool xdotool xdotool xdotool
need xclip xclip xclip xclip
need weston weston weston weston
need dbus-daemon dbus dbus-daemon dbus
need gdbus libglib2.0-bin glib2 glib2
need '/usr/lib*/at-spi-bus-launcher' at-spi2-core at-spi2-core at-spi2-core
need '/usr/lib*/*/libxkbcommon.so.0' libxkbcommon0 libxkbcommon libxkbcommon
need '/usr/lib*/*/libxkbcommon-x11.so.0' libxkbcommon-x11-0 libxkbcommon-x11 libxkbcommon-x11
need '/usr/lib*/*/libX11-xcb.so.1' libx11-xcb1 libX11-xcb libx11
need '/usr/lib*/*/libXcursor.so.1' libxcursor1 libXcursor libxcursor
need '/usr/lib*/*/libXi.so.6' libxi6 libXi libxi
need '/usr/lib*/*/libwayland-client.so.0' libwayland-client0 libwayland-client wayland
need '/usr/lib*/*/libEGL_mesa.so.0' libegl1 mesa-libEGL mesa
# Simulated pens on a real X server.
need Xorg xserver-xorg-core xorg-x11-server-Xorg xorg-server
need '/usr/lib*/xorg/modules/drivers/dummy_drv.so' xserver-xorg-video-dummy xorg-x11-drv-dummy xf86-video-dummy
need '/usr/include/xorg/xorg-server.h' xserver-xorg-dev xorg-x11-server-devel xorg-server-devel
need pkg-config pkg-config pkgconf-pkg-config pkgconf
need '/usr/share/fonts/*/noto*/NotoSansCJK*' fonts-noto-cjk google-noto-sans-cjk-fonts noto-fonts-cjk
# A virtual machine with a kernel of its own, and what is booted in it.
need qemu-system-x86_64 qemu-system-x86 qemu-system-x86-core qemu-system-x86
need busybox busybox-static busybox busybox
need cpio cpio cpio cpio
install_needed || echo "some packages could not be installed; checks that need them will say so" >&2

# A fresh clone is compiled once: without records for the next time, which cost a fifth of it.
[ -d "${CARGO_TARGET_DIR:-target}" ] || export CARGO_INCREMENTAL=0
# One commit gives one answer; new inputs are what the fuzzers look for.
export PROPTEST_RNG_SEED=${PROPTEST_RNG_SEED:-2026}

passed=()
failed=()
not_run=()
times=()

# Where single tests note that they cannot run here, one a line; and what checks that run beside others print.
work=$(mktemp -d)
export PENSTEMON_NOT_RUN=$work/not_run
touch "$PENSTEMON_NOT_RUN"
trap 'rm -rf "$work"' EXIT

# processor PID: seconds of processor time that the ended children of a process have taken; 0 where no /proc says it.
processor() {
    local stat
    stat=$(cat "/proc/$1/stat" 2>/dev/null) || { echo 0; return; }
    # What stands behind the name, which may have spaces: the state first.
    set -- ${stat##*) }
    echo $(((${14} + ${15}) / 100))
}

# judge NAME STATUS SECONDS PROCESSOR_SECONDS: exit status 77 means that the check cannot run here.
judge() {
    times+=("$(printf '%5d s %6d s  %s' "$3" "$4" "$1")")
    case $2 in
        0) passed+=("$1") ;;
        77) not_run+=("$1") ;;
        *) failed+=("$1") ;;
    esac
}

# check NAME COMMAND…
check() {
    local name=$1 begin=$SECONDS status before
    before=$(processor "$$")
    shift
    echo
    echo "== $name"
    "$@"
    status=$?
    judge "$name" "$status" "$((SECONDS - begin))" "$(($(processor "$$") - before))"
}

# beside NAME COMMAND…: the same at once and beside what follows, in what processor time that leaves; `join` waits for all of
# these in turn and shows what they printed.
jobs_names=()
jobs=()
beside() {
    local file=$work/job_${#jobs_names[@]}
    jobs_names+=("$1")
    shift
    (
        begin=$SECONDS here=$BASHPID
        nice -n 19 "$@" >"$file" 2>&1
        echo "$? $((SECONDS - begin)) $(processor "$here")" >"$file.status"
    ) &
    jobs+=($!)
}

join() {
    local i status seconds cpu
    wait "${jobs[@]}"
    jobs=()
    for i in "${!jobs_names[@]}"; do
        echo
        echo "== ${jobs_names[i]}"
        cat "$work/job_$i"
        read -r status seconds cpu <"$work/job_$i.status"
        judge "${jobs_names[i]}" "$status" "$seconds" "$cpu"
    done
    jobs_names=()
}

program=${CARGO_TARGET_DIR:-target}/debug/penstemon
build_sketches() {
    local folder=target/sketches sketch name
    rm -rf "$folder" && mkdir -p "$folder" || return 1
    for sketch in assets/sketches/*.penstemon; do
        name=$(basename "$sketch" .penstemon)
        "$program" build "$sketch" -o "$folder/$name.glb" -o "$folder/$name.obj" || return 1
        "$program" check "$folder/$name.glb" >/dev/null || return 1
        "$program" check "$folder/$name.obj" >/dev/null || return 1
    done
    "$program" grow birch --age 12 --seed 3 -o "$folder/grown_birch.glb" -o "$folder/grown_birch.obj" || return 1
}

# What is downloaded comes while other things are compiled.
tests/interop.sh --fetch >"$work/fetch" 2>&1 &
fetch=$!

check "formatting" cargo fmt --check
# Much of a compiler's work is one thread, so two work beside each other, each in a folder that the other does not lock.
beside "lints" env CARGO_TARGET_DIR="${CARGO_TARGET_DIR:-target}/lints" cargo clippy --quiet --all-targets -- -D warnings
check "unit tests" cargo test --no-fail-fast --lib
join
check "other tests are compiled" cargo test --quiet --no-run --bins --test '*'
# What counts time, memory or bytes of its own, with nothing beside it.
alone=(--bins)
for tests in architecture docs files golden growth_memory parameter_ends pen_soak; do alone+=(--test "$tests"); done
check "tests of files, of the command line and of memory" cargo test --no-fail-fast "${alone[@]}"
# Windows mostly wait, so beside them run checks that only need a processor. Several are open at once.
beside "tests of plants and of the window without a display" cargo test --no-fail-fast --test plants --test app
check "tests of windows and pens" cargo test --test window -- --test-threads 4 --skip latency:: --skip memory::
join
check "tests of the window's speed and memory" cargo test --test window -- latency:: memory::
check "documentation" env RUSTDOCFLAGS="-D warnings" cargo doc --quiet --no-deps
wait "$fetch"
check "sketches build and pass our own judge" build_sketches
check "tablets on a real kernel, in QEMU" tests/kernel/run.sh
if $fuzz; then
    readers=(sketch_json sketch_svg species grammar model_reader journal pen_families pen_descriptor pen_recording)
    # For pictures the whole program is compiled once more.
    ! $nightly || readers+=(picture)
    check "fuzzing, ${FUZZ_SECONDS:=8} s a reader" fuzz/run.sh "$FUZZ_SECONDS" "${readers[@]}"
fi
# The judges are one thread, and the last of many libraries is compiled by one, too: so beside each other. These are last, since
# they compile much and may be left out where all before them was slow.
beside "trimesh, MeshLab and the Khronos validator" env PENSTEMON="$program" tests/interop.sh target/sketches
beside "licences, sources and advisories of dependencies" scripts/deny.sh "$SECONDS"
check "compiles for Windows and macOS" scripts/other_systems.sh "$SECONDS"
join

echo
echo "seconds, and seconds of processor time"
printf '%s\n' "${times[@]}"
printf '%5d s %6d s  together\n' "$SECONDS" "$(processor "$$")"
while IFS= read -r line; do not_run+=("$line"); done < <(sort -u "$PENSTEMON_NOT_RUN")
for name in "${not_run[@]+"${not_run[@]}"}"; do echo "not run here: $name"; done
for name in "${failed[@]+"${failed[@]}"}"; do echo "FAILED: $name"; done
echo "checks: ${#passed[@]} passed, ${#failed[@]} failed, ${#not_run[@]} skipped"
[ ${#failed[@]} -eq 0 ]
