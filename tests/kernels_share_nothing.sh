#!/bin/sh
# Of objects that are compiled for an instruction set: no inline function but those of its own namespace. The linker
# keeps one of several equal inline functions, and it might be the one that only some machines can run. Nor one that two
# of the objects have, unless its name tells that all round alike: one kernel may fuse operations, another may not.
#   tests/kernels_share_nothing.sh NAMESPACE OBJECTS...
set -eu
namespace=$1
shift
for object in "$@"; do
  nm -C "$object" > /dev/null
  shared=$(nm -C "$object" | grep ' [Wu] ' | grep -v "vex::$namespace::" || :)
  if [ -n "$shared" ]; then
    printf '%s has inline functions that are not its own:\n%s\n' "$object" "$shared" >&2
    exit 1
  fi
done
# Within an object a constructor has two symbols of one name.
twice=$(for object in "$@"; do nm -C "$object" | sed -n 's/^[0-9a-f]* W //p' | sort -u; done |
  sort | uniq -d | grep -v '::unfused::' || :)
if [ -n "$twice" ]; then
  printf 'inline functions of more than one of %s:\n%s\n' "$*" "$twice" >&2
  exit 1
fi
echo "$# objects of $namespace: no inline function but their own, each of one"
