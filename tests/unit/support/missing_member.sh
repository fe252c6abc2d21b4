#!/bin/sh
# A body that lacks a member: the compiler's first error names it.
#   missing_member.sh COMPILER SOURCE_FOLDER MEMBER
set -eu
compiler=$1
sources=$2
member=$3
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
{
  echo '#include "engine/support/convex_body.h"'
  echo 'struct Mine {'
  echo '  template <class L> vex::Vec3<L> support(const vex::Vec3<L>& dir) const { return dir; }'
  echo '  double support_error() const { return 0.0; }'
  echo '  vex::Vec3d centre() const { return {}; }'
  echo '  double circumradius() const { return 1.0; }'
  echo '  double inradius() const { return 0.0; }'
  echo '};'
  echo 'vex::ConvexBody body() { return Mine{}; }'
} > "$folder/whole.cpp"
grep -v " $member()" "$folder/whole.cpp" > "$folder/part.cpp"
"$compiler" -std=c++20 -fsyntax-only -I"$sources" "$folder/whole.cpp"
if "$compiler" -std=c++20 -fsyntax-only -I"$sources" "$folder/part.cpp" 2> "$folder/said"; then
  echo "a body without $member compiles" >&2
  exit 1
fi
first=$(grep 'error' "$folder/said" | head -n 1)
echo "$first"
case $first in
  *"a convex body needs: "*" $member() const"*) ;;
  *) exit 1 ;;
esac
