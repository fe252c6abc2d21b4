#!/bin/sh
# Local links of the markdown files below DOC_DIR lead to installed files, or to code: tests, apps, engine and the like,
# which a reader of installed documentation finds in the sources.
#
#   sh tests/package/check_links.sh DOC_DIR SOURCE_DIR
set -eu
source_dir=$2
cd -- "$1"
links=$(mktemp)
trap 'rm -f "$links"' EXIT

# FILE TARGET, one a line, without code blocks and anchors.
find . -name '*.md' -exec awk '
  FNR == 1 { fenced = 0 }
  /^```/ { fenced = !fenced }
  fenced || /^    / { next }
  {
    line = $0
    while (match(line, /\[[^]]+\]\([^) ]+\)/)) {
      link = substr(line, RSTART, RLENGTH)
      line = substr(line, RSTART + RLENGTH)
      sub(/.*\]\(/, "", link)
      sub(/[#)].*/, "", link)
      if (link != "" && link !~ /^[a-z]+:/) print FILENAME " " link
    }
  }' {} + >"$links"

n_links=0
n_dead=0
while read -r file target; do
  n_links=$((n_links + 1))
  path=$(dirname "$file")/$target
  if [ -e "$path" ]; then continue; fi
  below=$(realpath -m --relative-to . "$path")
  case $below in
    tests/* | apps/* | engine/* | shapes/* | meshes/* | cmake/*) if [ -e "$source_dir/$below" ]; then continue; fi ;;
  esac
  printf 'dead link in %s: %s\n' "${file#./}" "$target"
  n_dead=$((n_dead + 1))
done <"$links"
printf '  %s local links\n' "$n_links"
[ "$n_links" -ge 10 ] && [ "$n_dead" -eq 0 ]
