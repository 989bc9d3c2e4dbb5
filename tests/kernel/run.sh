#!/usr/bin/env bash
# Does a real kernel's hidraw give us tablets as we think? Boots Debian's cloud kernel in QEMU with nothing but busybox and
# `guest/`, which plugs virtual tablets in through /dev/uhid and reads them with the library's own code.
#
#   tests/kernel/run.sh
#
# The guest says one line a check over its serial port, and its verdict last. Exit code 0: all checks hold; 1: one does
# not; 77: not run, because something is missing or QEMU boots nothing here, which is then named.
set -euo pipefail
cd "$(dirname "$0")/../.."

cache=${PENSTEMON_KERNEL_CACHE:-target/kernel}
# Without help from the processor the guest takes some seconds; a machine that is busy gets more.
patience_s=${PENSTEMON_KERNEL_PATIENCE_S:-240}
# In the order in which they need each other.
modules="hid uhid hid-generic"
mkdir -p "$cache"
cache=$(realpath "$cache")

not_run() {
    echo "kernel: not run: $1" >&2
    exit 77
}

[ "$(uname -sm)" = "Linux x86_64" ] || not_run "the guest is a Linux on x86_64"
for program in qemu-system-x86_64 busybox cpio gzip ldd; do
    command -v "$program" >/dev/null || not_run "needs $program"
done

# Unpacks Debian's kernel; nothing of it is installed.
fetch_kernel() {
    local package
    package=$(apt-cache depends linux-image-cloud-amd64 2>/dev/null | awk '/Depends: linux-image/ {print $2; exit}')
    [ -n "$package" ] || return
    rm -rf "$cache/fetched" "$cache/linux"
    mkdir "$cache/fetched"
    # By the user who runs this, since apt's own user may not be allowed to write here.
    (cd "$cache/fetched" && apt-get download -qq -o APT::Sandbox::User="$(id -un)" "$package") || return
    dpkg-deb -x "$cache"/fetched/linux-image-*.deb "$cache/fetched/linux" || return
    mv "$cache/fetched/linux" "$cache/linux" && rm -r "$cache/fetched"
}

if ! compgen -G "$cache/linux/boot/vmlinuz-*" >/dev/null; then
    command -v apt-get >/dev/null && command -v dpkg-deb >/dev/null || not_run "there is no apt-get to fetch a kernel"
    as_root=()
    [ "$(id -u)" = 0 ] || as_root=(sudo -n)
    echo "kernel: fetching Debian's linux-image-cloud-amd64" >&2
    { fetch_kernel || { "${as_root[@]}" apt-get update -qq && fetch_kernel; }; } >"$cache/apt.log" 2>&1 ||
        not_run "Debian's kernel packages are out of reach (see $cache/apt.log)"
fi
kernel=$(ls "$cache"/linux/boot/vmlinuz-*)

# As an example, so that the dependencies are those of the tests and need no second build.
cargo build --quiet --example hid_guest
guest=${CARGO_TARGET_DIR:-target}/debug/examples/hid_guest

root=$cache/root
rm -rf "$root"
mkdir -p "$root/bin" "$root/modules"
cp "$(command -v busybox)" "$root/bin/busybox"
cp "$guest" "$root/bin/penstemon-guest"
strip "$root/bin/penstemon-guest" 2>/dev/null || true
# What they load, where they look for it; a static program loads nothing.
for program in "$root"/bin/*; do
    { ldd "$program" 2>/dev/null || true; } | { grep -o '/[^ ]*' || true; } | while read -r library; do
        cp -L --parents "$library" "$root/"
    done
done
for module in $modules; do
    found=$(find "$cache/linux" -name "$module.ko*" -print -quit)
    case $found in
        *.ko) cp "$found" "$root/modules/" ;;
        *.ko.xz) xz -dc "$found" >"$root/modules/$module.ko" || not_run "needs xz" ;;
        *) not_run "$kernel has no module $module" ;;
    esac
done
{
    echo '#!/bin/busybox sh'
    echo '/bin/busybox mkdir -p /proc /sys /dev'
    echo '/bin/busybox mount -t proc proc /proc'
    echo '/bin/busybox mount -t sysfs sysfs /sys'
    echo '/bin/busybox mount -t devtmpfs devtmpfs /dev'
    echo 'echo "guest: up"'
    echo "for module in $modules; do /bin/busybox insmod /modules/\$module.ko; done"
    echo '/bin/penstemon-guest 2>&1'
    echo '/bin/busybox reboot -f'
} >"$root/init"
chmod +x "$root/init"
(cd "$root" && find . | cpio --quiet -o -H newc | gzip -1) >"$cache/initramfs.gz"

# Emulated, so that it is the same everywhere: where processors lend themselves to guests, their kernels may not. The
# guest's clock counts its instructions and skips its idle moments, so that a busy machine makes nothing late.
console=$cache/console.log
timeout "$patience_s" qemu-system-x86_64 -accel tcg -icount shift=2,sleep=off -cpu max -machine q35 -m 256 \
    -smp 1 -nodefaults -nographic -no-reboot -serial stdio -kernel "$kernel" -initrd "$cache/initramfs.gz" \
    -append "console=ttyS0 panic=-1 quiet mitigations=off nokaslr" </dev/null >"$console" 2>&1 || true
if grep -aq 'PENSTEMON-GUEST ok' "$console"; then
    grep -a 'PENSTEMON-GUEST' "$console"
    exit 0
fi
tail -n 40 "$console" >&2
grep -aq 'guest: up' "$console" || not_run "QEMU did not bring a guest up within $patience_s s (see $console)"
echo "kernel: FAILED (see $console)" >&2
exit 1
