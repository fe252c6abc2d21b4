#!/bin/sh
# Measures the table of docs/percolation.md, body by body, and writes docs/percolation/table.md.
#
#   sh docs/percolation/measure.sh [SECONDS [NAME [ERROR]]]
#
# SECONDS more of each body (60), or of the one of this name alone ('' is each); of those alone, and no longer, whose
# error of eta_c is above ERROR, where it is given. A SECONDS of 0 only writes the table.
#
# Each run goes on where the last one ended: what it has is kept in build/percolation. The bodies are those of
# docs/percolation/bodies.txt.
set -eu
root=$(CDPATH='' cd -- "$(dirname -- "$0")/../.." && pwd -P)
seconds=${1:-60}
only=${2:-}
error=${3:-}
cd -- "$root"
sh cmake/prepare.sh release vex_percolate
runs=$root/build/percolation
mkdir -p "$runs"

# The k-th number behind "key" of a document.
number() {
  awk -v key="\"$2\":" -v nth="$3" 'index($0, key) { found = 1 }
    found && match($0, /-?[0-9][0-9.e+-]*,?$/) { n++; if (n == nth) { gsub(/[ ,]/, "", $NF); print $NF; exit } }' "$1"
}
# value(error in units of the last digits)
with_error() {
  awk -v x="$1" -v e="$2" 'BEGIN { if (x == "" || e == "" || e <= 0) { print "-"; exit }
    d = 0; f = e; while (f < 9.5 && d < 15) { f *= 10; d++ }
    printf "%.*f(%d)\n", d, x, f + .5 }'
}

table=$root/docs/percolation/table.md
new=$runs/table.md
{
  printf '# Percolation thresholds, measured\n\n'
  printf 'Written by `sh docs/percolation/measure.sh`; what the columns are, and the sources in brackets: '
  printf '[percolation.md](../percolation.md).\n\n'
  printf '| body | η_c | φ_c | B_c | p of the fit | realisations | sizes | seconds | published |\n'
  printf '|---|---|---|---|---|---|---|---|---|\n'
} >"$new"
grep -v '^#' docs/percolation/bodies.txt | while IFS='|' read -r name arguments published; do
  name=$(printf '%s' "$name" | sed 's/ *$//')
  file=$(printf '%s' "$name" | tr -c 'A-Za-z0-9\n' '_')
  wanted=1
  if [ "$seconds" = 0 ] || { [ -n "$only" ] && [ "$only" != "$name" ]; }; then wanted=''; fi
  goal=''
  if [ -n "$error" ]; then
    # eta of flat bodies is 0, and has no error.
    case $arguments in *disc:* | *plate:*) wanted='' ;; *) goal="--std-error $error" ;; esac
  fi
  if [ -n "$wanted" ]; then
    resume=''
    if [ -f "$runs/$file.csv" ]; then resume="--resume $runs/$file.csv"; fi
    printf '%s\n' "$name" >&2
    # shellcheck disable=SC2086
    build/release/bin/vex_percolate $arguments $resume $goal --seconds "$seconds" --checkpoint "$runs/$file.csv" \
      --json "$runs/$file.json" --quiet
  fi
  json=$runs/$file.json
  if [ ! -f "$json" ]; then continue; fi
  eta=-
  phi=-
  if ! grep -q '"eta_c": null' "$json"; then
    eta=$(with_error "$(number "$json" eta_c 1)" "$(number "$json" eta_c 2)")
    phi=$(with_error "$(number "$json" phi_c 1)" "$(number "$json" phi_c 2)")
  fi
  b=-
  if ! grep -q '"b_c": null' "$json"; then b=$(with_error "$(number "$json" b_c 1)" "$(number "$json" b_c 2)"); fi
  sizes=$(grep '"size":' "$json" | sed 's/.*: *//; s/,//; s/\.0$//' | tr '\n' ' ' | sed 's/ $//')
  printf '| %s | %s | %s | %s | %.2g | %s | %s | %.0f | %s |\n' "$name" "$eta" "$phi" "$b" \
    "$(number "$json" p_value 1)" "$(number "$json" realisations 1)" "$sizes" "$(number "$json" seconds 1)" \
    "$(printf '%s' "$published" | sed 's/^ *//; s/ *$//')" >>"$new"
done
mv "$new" "$table"
