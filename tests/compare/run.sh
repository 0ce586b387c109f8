#!/bin/sh
# Renders every sample scene with lambert and with POV-Ray and writes a table.
# usage: run.sh LAMBERT OUT [SCENES-FOLDER]   (JOBS=n: so many at once)
lambert=$1 out=$2 scenes=${3:-/usr/share/doc/povray/examples}
mkdir -p "$out/rows" "$out/cache" || exit 1
rm -f "$out"/rows/*

# One scene a process, so that one that brings lambert down takes no other with it.
find "$scenes" -name '*.pov' | sort | grep -n '' >"$out/list"
xargs -P "${JOBS:-2}" -d '\n' -n 1 sh -c '
  number=${3%%:*} scene=${3#*:}
  "$1" compare "$scene" --csv --out "$2/pictures" --reference-cache "$2/cache" \
    --time-limit 60 +W160 +H120 -A +WT1 | tail -n 1 >"$2/rows/$(printf %04d "$number")"
' sh "$lambert" "$out" <"$out/list"

echo 'scene,verdict,off_percent,rmse,psnr_db,reference_seconds,lambert_seconds,ratio,reason' \
  >"$out/table.csv"
cat "$out"/rows/* | sort -t , -k 2,2 -k 3,3g >>"$out/table.csv"
{
  echo "scenes by verdict:"
  tail -n +2 "$out/table.csv" | cut -d , -f 2 | sort | uniq -c | sort -rn
  echo
  echo "reasons for not rendering:"
  grep ',not rendered,' "$out/table.csv" | sed 's/^.*,"\(.*\)"$/\1/' | sort | uniq -c |
    sort -rn | head -40
  echo
  echo "time, POV-Ray and lambert, over the scenes that match (whole processes):"
  awk -F , '$2 == "match" && $6 > 0 && $7 > 0 {p += $6; l += $7; r += log($6 / $7); n++}
    END {if (n) printf "%.1f s %.1f s, lambert is %.1f times faster in the geometric mean (%d scenes)\n", p, l, exp(r / n), n}' \
    "$out/table.csv"
} | tee "$out/summary.txt"
