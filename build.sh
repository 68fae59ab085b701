#!/usr/bin/env bash
# Builds Plumb on a Debian 12 machine and shows or tests it. Run without arguments for the words.
set -euo pipefail
cd "$(dirname "$0")"

readonly PACKAGES=(
  g++ cmake ninja-build ccache git ca-certificates curl pkg-config
  libeigen3-dev libassimp-dev zlib1g-dev assimp-testmodels libqhull-dev nlohmann-json3-dev libcli11-dev
  libgtest-dev libbenchmark-dev libbox2d-dev gnuplot-nox
)
# The Rerun SDK that replay is built on asks for this Rust; Debian 12's package `cargo` is older.
readonly RUST_NEEDED=1.95
readonly BUILD=build/release
readonly PROGRAM=$BUILD/bin/plumb
readonly DEMO_SCENE=assets/scenes/default.json
readonly DEMO_RECORDING=build/demo/default.rrd
JOBS=$(nproc)
export NINJA_STATUS='[%f/%t] '

step() { printf '== %s\n' "$*"; }
fail() { printf 'build.sh: %s\n' "$*" >&2; exit 1; }

usage() {
  cat <<'TEXT'
./build.sh demo     build the program, run the default scene, leave a recording for the Rerun viewer
./build.sh test     build everything and run all tests
./build.sh format   bring all C++ into the house format (clang-format-16)
./build.sh help     this text

On Debian 12 what is missing is installed first (as root, or through sudo). Everything that is built
lies in build/; the recorder's Rust part, ten minutes or more on two cores, is built once a machine.
TEXT
}

as_root() {
  if [ "$(id -u)" -eq 0 ]; then
    DEBIAN_FRONTEND=noninteractive "$@"
  elif command -v sudo >/dev/null; then
    sudo DEBIAN_FRONTEND=noninteractive "$@"
  else
    fail "needs root to install packages. Run as root: apt-get install ${PACKAGES[*]}"
  fi
}

package_lists_fresh=no
update_package_lists() {
  [ $package_lists_fresh = yes ] && return
  step "apt-get update"
  as_root apt-get update -qq
  package_lists_fresh=yes
}

ensure_packages() {
  if ! command -v dpkg-query >/dev/null; then
    step "not a Debian system: taking for granted the likes of ${PACKAGES[*]}"
    return
  fi
  local missing=() name
  for name in "${PACKAGES[@]}"; do
    [ "$(dpkg-query -W -f '${db:Status-Status}' "$name" 2>/dev/null)" = installed ] ||
      missing+=("$name")
  done
  [ ${#missing[@]} -eq 0 ] && return
  update_package_lists
  step "installing ${missing[*]}"
  apt_install "${missing[@]}" || fail "apt-get could not install them; its words are above"
}

# Quiet unless it fails.
apt_install() {
  local log status=0
  log=$(mktemp)
  as_root apt-get install -y -qq --no-install-recommends --no-remove "$@" >"$log" 2>&1 || status=$?
  [ $status -eq 0 ] || cat "$log"
  rm -f "$log"
  return $status
}

# Whether version $1 is at least $2.
at_least() { [ "$(printf '%s\n%s\n' "$2" "$1" | sort -V | head -n 1)" = "$2" ]; }

rust_is_new_enough() {
  local version
  command -v cargo >/dev/null && command -v rustc >/dev/null || return 1
  version=$(rustc --version 2>/dev/null | cut -d ' ' -f 2) && [ -n "$version" ] || return 1
  at_least "$version" "$RUST_NEEDED"
}

# Three ways to a Rust that is new enough, the least intrusive first.
ensure_rust() {
  rust_is_new_enough && return
  PATH="$HOME/.cargo/bin:$PATH"
  rust_is_new_enough && return

  if command -v apt-cache >/dev/null; then
    # Debian 12 keeps a current Rust for building browsers, under names of its own.
    update_package_lists
    local candidate
    candidate=$(apt-cache policy cargo-web | awk '/Candidate:/ {print $2}')
    if at_least "${candidate:-0}" "$RUST_NEEDED"; then
      step "installing cargo-web rustc-web (Rust $candidate)"
      if apt_install cargo-web rustc-web; then
        PATH="/usr/bin:$PATH"
        rust_is_new_enough && return
      fi
    fi
  fi

  if command -v rustup >/dev/null; then
    step "rustup: installing the stable toolchain"
    rustup toolchain install stable --profile minimal --no-self-update || true
    export RUSTUP_TOOLCHAIN=stable
  else
    step "installing Rust with rustup (https://rustup.rs) into $HOME/.cargo"
    curl --proto '=https' --tlsv1.2 -sSf https://sh.rustup.rs |
      sh -s -- -y --profile minimal --no-modify-path || true
    PATH="$HOME/.cargo/bin:$PATH"
  fi
  rust_is_new_enough && return
  fail "replay needs Rust $RUST_NEEDED or newer, and none could be installed.
Install it by hand (https://rustup.rs, or Debian's packages cargo-web and rustc-web), put cargo on
PATH and run this again. Without recordings Plumb builds with: cmake --preset release -DPLUMB_REPLAY=OFF"
}

# Configures, and builds the given targets (none: everything).
build() {
  ensure_packages
  ensure_rust
  step "configuring $BUILD"
  mkdir -p $BUILD
  cmake --preset release -DPLUMB_REPLAY=ON "-DPLUMB_CARGO=$(command -v cargo)" \
    >$BUILD/configure.log || { cat $BUILD/configure.log; fail "configuring failed"; }
  step "building with $JOBS jobs"
  if [ $# -eq 0 ]; then
    cmake --build $BUILD -j "$JOBS"
  else
    cmake --build $BUILD -j "$JOBS" --target "$@"
  fi
}

demo() {
  build plumb
  mkdir -p "$(dirname $DEMO_RECORDING)"
  step "$PROGRAM run $DEMO_SCENE -o $DEMO_RECORDING"
  $PROGRAM run $DEMO_SCENE -o $DEMO_RECORDING
  step "recording: $DEMO_RECORDING"
  step "open it:   rerun $DEMO_RECORDING      (the viewer: pip install rerun-sdk)"
}

run_tests() {
  build
  step "testing"
  ctest --test-dir $BUILD --output-on-failure --no-tests=error -j 2
}

format() {
  command -v clang-format-16 >/dev/null || fail "clang-format-16 is missing: apt-get install it"
  git ls-files -co --exclude-standard -z -- '*.h' '*.cpp' | xargs -0 clang-format-16 -i
}

case "${1:-help}" in
  demo) demo ;;
  test) run_tests ;;
  format) format ;;
  help | -h | --help) usage ;;
  *) usage >&2; fail "unknown word '$1'" ;;
esac
