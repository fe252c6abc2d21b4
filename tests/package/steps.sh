# shellcheck shell=sh
# Read by the tests of this folder: a folder of their own, gone when they end, and how they tell what they do.
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
trap 'exit 1' HUP INT TERM

fail() {
  printf 'FAILED: %s\n' "$*"
  exit 1
}
step() { printf -- '- %s\n' "$*"; }
# quietly COMMAND...: what it prints is shown only if it fails.
quietly() {
  if ! "$@" >"$scratch/log" 2>&1; then
    cat "$scratch/log"
    fail "$*"
  fi
}
