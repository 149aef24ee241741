#!/bin/sh
# Prepares a machine for `make study` and `make test`. Safe to run again: what
# is there already is left alone, and every change is announced.
#
# 1. A Vulkan adapter. Where none is found, Mesa's software driver is installed
#    through the package manager. Where there is a GPU nothing is installed.
# 2. A mesh and two environment maps from Debian packages, unpacked into
#    target/assets and checked. Nothing is installed for them; where they cannot
#    be had, the study leaves their scenes out and says so.
set -eu
cd "$(dirname "$0")"
ASSETS=target/assets

say() { printf 'setup: %s\n' "$*"; }

# Runs a command as root: directly, or through sudo where that is possible.
as_root() {
    if [ "$(id -u)" = 0 ]; then
        "$@"
    elif command -v sudo >/dev/null && { sudo -n true 2>/dev/null || [ -t 0 ]; }; then
        sudo "$@"
    else
        return 1
    fi
}

apt_update() {
    [ -z "${updated:-}" ] || return 0
    updated=yes
    say "refreshing the package lists (apt-get update)"
    as_root apt-get update -q -o Acquire::Retries=1 -o Acquire::http::Timeout=20 >/dev/null 2>&1
}

# Asks the Vulkan loader itself how many devices there are.
adapter_found() {
    [ "$(uname)" = Linux ] || return 0 # Metal and DX12 come with the system
    python3 - <<'PYTHON'
import ctypes, sys
try:
    vulkan = ctypes.CDLL("libvulkan.so.1")
except OSError:
    sys.exit(1)
# VkInstanceCreateInfo: sType = 1, everything else empty.
info = (ctypes.c_uint64 * 8)(1, 0, 0, 0, 0, 0, 0, 0)
instance, count = ctypes.c_void_p(), ctypes.c_uint32(0)
if vulkan.vkCreateInstance(info, None, ctypes.byref(instance)) != 0:
    sys.exit(1)
vulkan.vkEnumeratePhysicalDevices(instance, ctypes.byref(count), None)
sys.exit(0 if count.value > 0 else 1)
PYTHON
}

install_adapter() {
    if command -v apt-get >/dev/null; then
        say "no Vulkan adapter found: installing mesa-vulkan-drivers and libvulkan1 (a software driver)"
        apt_update || true
        if as_root env DEBIAN_FRONTEND=noninteractive \
            apt-get install -y -q --no-install-recommends mesa-vulkan-drivers libvulkan1 >/dev/null &&
            adapter_found; then
            say "the software driver works"
            return
        fi
    fi
    say "no Vulkan adapter found, and none could be installed from here."
    say "Install a GPU driver, or a software driver, as root and run this again:"
    say "  Debian, Ubuntu   apt-get install mesa-vulkan-drivers libvulkan1"
    say "  Fedora           dnf install mesa-vulkan-drivers vulkan-loader"
    say "  Arch             pacman -S vulkan-swrast vulkan-icd-loader"
    exit 1
}

# Succeeds if target/assets/$1 is the file we know.
known() {
    [ -f "$ASSETS/$1" ] && printf '%s  %s\n' "$2" "$ASSETS/$1" | sha256sum -c --status
}

# fetch PACKAGE, then pairs: FILE-IN-PACKAGE SHA256
fetch() {
    package=$1
    shift
    missing=
    for wanted in "$@"; do
        known "$(basename "${wanted%=*}")" "${wanted#*=}" || missing=yes
    done
    [ -n "$missing" ] || return 0
    say "unpacking input from the Debian package $package into $ASSETS (not installed)"
    scratch=$(mktemp -d)
    if ! download "$package" "$scratch"; then
        say "$package cannot be downloaded: the study leaves its scenes out"
        rm -rf "$scratch"
        return 0
    fi
    dpkg-deb -x "$scratch"/*.deb "$scratch/content"
    mkdir -p "$ASSETS"
    for wanted in "$@"; do
        place "$scratch/content/${wanted%=*}" "${wanted#*=}"
    done
    rm -rf "$scratch"
}

download() {
    command -v apt-get >/dev/null && command -v dpkg-deb >/dev/null || return 1
    chmod 755 "$2" # apt's own user writes there
    try_download "$@" || { apt_update && try_download "$@"; }
}

try_download() {
    (cd "$2" && apt-get download -q -o Acquire::Retries=1 -o Acquire::http::Timeout=20 "$1" >/dev/null 2>&1)
    ls "$2"/*.deb >/dev/null 2>&1
}

# place FILE SHA256: a file that is not the one we know is not used.
place() {
    name=$(basename "$1")
    if ! printf '%s  %s\n' "$2" "$1" | sha256sum -c --status 2>/dev/null; then
        say "$name of this release is not the file this project was checked with: its scenes are left out"
        return 0
    fi
    cp "$1" "$ASSETS/.$name.part"
    mv "$ASSETS/.$name.part" "$ASSETS/$name"
}

adapter_found || install_adapter

fetch glmark2-data \
    usr/share/glmark2/models/bunny.obj=bff773d28c62e80187b2dfa8c6c8cc771a4c7707ddcdcf2e515913d322d1f548
worlds=usr/share/blender/datafiles/studiolights/world
fetch blender-data \
    $worlds/studio.exr=e501dd8a1172bd0e03903ede7f452300f8368448fe74720600338304d79281d9 \
    $worlds/courtyard.exr=1518fa37da6a8a389810a7a70262c410553018a51f0be9e248155b9bb363ff3d
