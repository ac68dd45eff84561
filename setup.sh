#!/usr/bin/env bash
# Installs what Debian 12 has to offer for building (./setup.sh build), for testing too
# (./setup.sh test), or for fuzzing too (./setup.sh fuzz). Does nothing, quickly, where all of it is there.
set -euo pipefail
cd "$(dirname "$0")"

build_packages=(
    g++ cmake ninja-build pkg-config
    libembree-dev libtbb-dev libglm-dev libhwy-dev libgmp-dev libxxhash-dev libdeflate-dev
    libopenimageio-dev libavcodec-dev libpng-dev libtinygltf-dev libdraco-dev nlohmann-json3-dev
    libosmesa6-dev libegl-dev libegl1
    libcli11-dev libfmt-dev libcereal-dev duktape-dev
)
test_packages=(libgtest-dev libbenchmark-dev libxml2-utils clang-format assimp-testmodels chromium fonts-dejavu-core locales time
    dpkg-dev file povray python3-ogre-1.12 xvfb xauth slurmctld slurmd)
# libFuzzer comes with clang's run-time libraries; llvm has the symbolizer of its reports.
fuzz_packages=(clang-14 libclang-rt-14-dev llvm-14 assimp-testmodels)

case ${1:-} in
build) wanted=("${build_packages[@]}") ;;
test)
    wanted=("${build_packages[@]}" "${test_packages[@]}")
    # Whoever has Node.js from elsewhere keeps it.
    command -v node >/dev/null || wanted+=(nodejs)
    command -v npm >/dev/null || wanted+=(npm)
    ;;
fuzz) wanted=("${build_packages[@]}" "${fuzz_packages[@]}") ;;
*) echo "usage: ./setup.sh build|test|fuzz" >&2; exit 2 ;;
esac

command -v dpkg-query >/dev/null || {
    echo "setup.sh: knows Debian's packages only; install these by other means: ${wanted[*]}" >&2
    exit 3
}
missing=()
for package in "${wanted[@]}"; do
    # A package that dpkg has never heard of prints nothing, and is missing too.
    [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null)" = installed ] ||
        missing+=("$package")
done

if [ ${#missing[@]} -gt 0 ]; then
    as_root=()
    if [ "$(id -u)" != 0 ]; then
        command -v sudo >/dev/null || {
            echo "setup.sh: packages are missing, and only root may install them; as root, run" >&2
            echo "  apt-get install --no-install-recommends ${missing[*]}" >&2
            exit 3
        }
        as_root=(sudo)
    fi
    echo "setup.sh: installing ${missing[*]}"
    apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qq
         -o DPkg::Lock::Timeout=300 -o Dpkg::Use-Pty=0)
    # apt-get waits for the lock of the packages, but not for that of the lists.
    for attempt in {1..60}; do
        "${apt[@]}" update && break
        [ "$attempt" -lt 60 ] || exit 3
        sleep 5
    done
    "${apt[@]}" install --yes --no-install-recommends "${missing[@]}" >/dev/null
fi

# The Khronos glTF validator, a JSON Schema validator and the browser's driver and judge of
# accessibility, at the versions of the lock file.
if [ "$1" = test ] && ! cmp -s tests/package-lock.json tests/node_modules/.installed; then
    npm ci --prefix tests --no-audit --no-fund --loglevel=error
    cp tests/package-lock.json tests/node_modules/.installed
fi
