#!/bin/sh
# SPDX-License-Identifier: MIT
# Neither the library nor the program calls a function of the C library whose result that may choose: sine, logarithm and
# the like are our own. What IEEE 754 or C defines to the last bit (sqrt, floor, fmod, ldexp, ...) is free.
# usage: elementary_symbols.sh FILE... (archives, object files and programs)
set -eu
failed=0
for file; do
    symbols=$(nm --undefined-only "$file")
    [ -n "$symbols" ] || { echo "$file needs no symbol at all"; exit 1; }
    names=$(printf '%s\n' "$symbols" | awk '$1 == "U" { sub(/@.*/, "", $2); print $2 }' | sort -u |
        grep -E '^_*(a?(sin|cos|tan)h?|atan2|sincos|exp|exp2|exp10|expm1|pow|log|log2|log10|log1p|cbrt|hypot|[lt]gamma|erfc?|j[01n]|y[01n]|pow10)[fl]?(_finite)?$' ||
        true)
    if [ -n "$names" ]; then
        echo "$file calls" $names
        failed=$((failed + 1))
    fi
done
echo "$(($# - failed)) passed, $failed failed"
[ $failed -eq 0 ]
