#!/bin/sh
# The man pages say all that --help says, and groff formats them without a warning.
#
#   sh tests/package/man_pages_test.sh MAN_DIR PROGRAM...
set -eu
man_dir=$1
shift

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
trap 'exit 1' HUP INT TERM

n_failed=0
fail() {
  n_failed=$((n_failed + 1))
  printf 'FAILED: %s\n' "$*"
}

for program; do
  name=$(basename "$program")
  page=$scratch/$name.1
  gzip -dc "$man_dir/$name.1.gz" >"$page"

  # The tags of the page's paragraphs, without fonts and escapes: "-h, --help", "--seed N".
  awk 'tagged { print } { tagged = ($0 == ".TP") }' "$page" |
    sed 's/\\f[A-Z]//g; s/\\[,/]//g; s/\\-/-/g' >"$scratch/tags"
  "$program" --help >"$scratch/help"
  sed -n 's/^  \(-., \)\{0,1\}\(--[a-z][a-z0-9-]*\).*/\2/p' "$scratch/help" >"$scratch/options"
  [ "$(wc -l <"$scratch/options")" -ge 5 ] || fail "$name: no options found in --help"
  while read -r option; do
    grep -qE -e "(^|, )$option( |\$)" "$scratch/tags" || fail "$name: $option has no paragraph in its man page"
  done <"$scratch/options"
  # What else is indented by two: positional arguments, named bodies, exit codes.
  sed -n 's/^  \([^- ][^ ]*\( [^ ]\{1,\}\)*\)\(  .*\)\{0,1\}$/\1/p' "$scratch/help" >"$scratch/others"
  [ -s "$scratch/others" ] || fail "$name: nothing but options found in --help"
  while read -r tag; do
    grep -qxF -e "$tag" "$scratch/tags" || fail "$name: $tag has no paragraph in its man page"
  done <"$scratch/others"

  for section in NAME SYNOPSIS DESCRIPTION OPTIONS EXAMPLES; do
    grep -qx ".SH $section" "$page" || fail "$name: no section $section"
  done
  [ "$(sed -n '/^\.SH NAME/{n;s/ .*//p;}' "$page")" = "$name" ] || fail "$name: its man page is of another name"

  LC_ALL=C groff -man -Tutf8 -ww -z "$page" >"$scratch/warnings" 2>&1 || fail "$name: groff"
  if [ -s "$scratch/warnings" ]; then
    cat "$scratch/warnings"
    fail "$name: groff warns"
  fi
done

if [ "$n_failed" -gt 0 ]; then exit 1; fi
echo "all expectations met"
