#!/bin/sh
# lambert mesh: closed, oriented, of the right genus, volume and area; three formats.
. "${top_srcdir:-.}/tests/cli/common.sh"

# Of the mesh in x.obj: edges that do not have one triangle on each side, Euler number,
# volume, area.
measure()
{
  awk '
    $1 == "v" {n++; x[n] = $2; y[n] = $3; z[n] = $4}
    $1 == "f" {
      t++
      for (k = 2; k <= 4; k++) {
        a = $k; b = $(k == 4 ? 2 : k + 1)
        edge[a " " b]++
        used[a] = 1
      }
      a = $2; b = $3; c = $4
      ux = x[b] - x[a]; uy = y[b] - y[a]; uz = z[b] - z[a]
      vx = x[c] - x[a]; vy = y[c] - y[a]; vz = z[c] - z[a]
      nx = uy * vz - uz * vy; ny = uz * vx - ux * vz; nz = ux * vy - uy * vx
      area += sqrt(nx * nx + ny * ny + nz * nz) / 2
      volume += (x[a] * nx + y[a] * ny + z[a] * nz) / 6
    }
    END {
      for (e in edge) {
        split(e, p, " ")
        if (edge[e] != 1 || edge[p[2] " " p[1]] != 1) bad++
        edges++
      }
      for (v in used) vertices++
      printf "%d %d %.9g %.9g\n", bad, vertices - edges / 2 + t, volume, area
    }' x.obj
}

# solid EULER VOLUME AREA TOLERANCE OBJECT
solid()
{
  printf '#version 3.7;\nglobal_settings {assumed_gamma 1}\n%s\n' "$5" >solid.pov
  exits 0 "$lambert" mesh solid.pov -o x.obj --mesh-resolution=24 -q || return 1
  measure >got
  awk -v e="$1" -v v="$2" -v a="$3" -v t="$4" '
    function off(x, y) {return x < y * (1 - t) || x > y * (1 + t)}
    {exit $1 != 0 || $2 != e || off($3, v) || off($4, a)}' got && return
  echo "# edges that are wrong, Euler number, volume, area: $(cat got), not 0 $1 $2 $3"
  return 1
}
pi=3.14159265358979
f() { awk "BEGIN {pi = $pi; printf \"%.9f\", $1}"; }

check "a ball" solid 2 "$(f '4 * pi / 3')" "$(f '4 * pi')" 0.01 'sphere {<3, 4, 5>, 1}'
check "a box, exactly" solid 2 24 52 0.000001 'box {-1, <1, 2, 3>}'
check "a turned box" solid 2 8 24 0.001 'box {-1, 1 rotate <20, 30, 40>}'
check "a torus" solid 0 "$(f '2 * pi * pi * 0.09')" "$(f '4 * pi * pi * 0.3')" 0.02 \
  'torus {1, 0.3}'
check "a drilled box" solid 0 "$(f '8 - pi / 2')" "$(f '24 + 1.5 * pi')" 0.005 \
  'difference {box {-1, 1} cylinder {-2 * y, 2 * y, 0.5}}'
check "drilled three times" solid -8 "$(f '8 - 6 * pi * 0.09 + 8 * sqrt(2) * 0.027')" 30.5585 \
  0.01 'difference {box {-1, 1} cylinder {-2 * x, 2 * x, 0.3} cylinder {-2 * y, 2 * y, 0.3}
  cylinder {-2 * z, 2 * z, 0.3}}'
check "a lens" solid 2 "$(f '2 * pi * 0.36 * 2.4 / 3')" "$(f '2 * 2 * pi * 0.6')" 0.01 \
  'intersection {sphere {-0.4 * z, 1} sphere {0.4 * z, 1}}'
check "a hollow ball" solid 4 "$(f '4 * pi / 3 * 0.784')" "$(f '4 * pi * 1.36')" 0.02 \
  'difference {sphere {0, 1} sphere {0, 0.6}}'
check "a cone's frustum" solid 2 "$(f 'pi * 2 / 3 * 1.75')" \
  "$(f 'pi * (1.5 * sqrt(4.25) + 1.25)')" 0.01 'cone {-y, 1, y, 0.5}'
check "faces that coincide" solid 2 12 32 0.001 \
  'merge {box {-1, 1} box {<1, -1, -1>, <2, 1, 1>}}'
check "half a ball: clips are closed" solid 2 "$(f '2 * pi / 3')" "$(f '3 * pi')" 0.03 \
  'sphere {0, 1 clipped_by {plane {<0.6, 0.8, 0>, 0}}}'
check "tiny and far" solid 2 8e-15 24e-10 0.01 \
  'box {-1e-5, 1e-5 translate <1, 2, 3>}'

# Vertices that stand for the rim of a lens, where two curved faces meet, lie on it: at
# least 60 around, as there are cells.
printf '#version 3.7;\nintersection {sphere {-0.4 * z, 1} sphere {0.4 * z, 1}}\n' >rim.pov
check "a curved edge" exits 0 "$lambert" mesh rim.pov -o x.obj --mesh-resolution=24 -q
on_rim() {
  awk '$1 == "v" {r = sqrt($2 ^ 2 + $3 ^ 2) - sqrt(0.84)
      if ($4 ^ 2 < 1e-14 && r ^ 2 < 1e-14) n++; else if (r > 1e-7) out++}
    END {print "# on the rim: " n ", beyond it: " out + 0; exit n < 60 || out}' x.obj
}
check "its vertices are on it" on_rim

# sheet EULER AREA TOLERANCE OBJECT: open, so only what does not need an inside
sheet()
{
  printf '#version 3.7;\n%s\n' "$4" >sheet.pov
  exits 0 "$lambert" mesh sheet.pov -o x.obj --mesh-resolution=48 -q || return 1
  awk -v e="$1" -v a="$2" -v t="$3" '
    $1 == "v" {n++; x[n] = $2; y[n] = $3; z[n] = $4}
    $1 == "f" {
      t3++
      for (k = 2; k <= 4; k++) {
        i = $k; j = $(k == 4 ? 2 : k + 1)
        if (edge[i " " j]++) bad++
        if (!(j " " i in edge)) edges++
        used[i] = 1
      }
      a1 = $2; b = $3; c = $4
      ux = x[b] - x[a1]; uy = y[b] - y[a1]; uz = z[b] - z[a1]
      vx = x[c] - x[a1]; vy = y[c] - y[a1]; vz = z[c] - z[a1]
      nx = uy * vz - uz * vy; ny = uz * vx - ux * vz; nz = ux * vy - uy * vx
      area += sqrt(nx * nx + ny * ny + nz * nz) / 2
    }
    END {
      for (v in used) vertices++
      euler = vertices - edges + t3
      printf "# wrong edges %d, Euler number %d, area %.9g\n", bad, euler, area
      exit bad || euler != e || area < a * (1 - t) || area > a * (1 + t)
    }' x.obj
}
check "a disc" sheet 1 "$(f '4 * pi')" 0.003 'disc {<1, 2, 3>, <1, 1, 1>, 2}'
check "a ring, stretched" sheet 0 "$(f '3 * 3 * pi')" 0.003 \
  'disc {0, z, 2, 1 scale <3, 1, 5>}'
check "a bicubic patch" sheet 1 9 0.000001 'bicubic_patch {type 1 flatness 0
  <0,0,0> <1,0,0> <2,0,0> <3,0,0> <0,1,0> <1,1,0> <2,1,0> <3,1,0>
  <0,2,0> <1,2,0> <2,2,0> <3,2,0> <0,3,0> <1,3,0> <2,3,0> <3,3,0>}'
check "sheets in a union" sheet 3 "$(f '2 * pi + 0.5')" 0.006 'union {disc {0, y, 1}
  disc {4 * y, y, 1} triangle {<5, 0, 0>, <6, 0, 0>, <5, 1, 0>}}'

# A ball (Euler number 2), a disc (1) and a triangle (1), moved together, areas times 4; the
# plane is named and left out.
check "solids and sheets of a union" sheet 4 "$(f '4 * (4 * pi + pi + 0.5)')" 0.02 'union {
  union {sphere {0, 1} disc {0, y, 1 translate 3 * x}} triangle {<5, 0, 0>, <6, 0, 0>, <5, 1, 0>}
  plane {y, -200} translate 100 scale 2 rotate 30 * z}'
exits 0 "$lambert" mesh sheet.pov -o x.obj --mesh-resolution=8
check "names the part that has no end" has err 'no end.*E0840'

cat >mesh.pov <<'EOS'
#version 3.7;
global_settings {assumed_gamma 1}
mesh {triangle {<0, 0, 0>, <0, 1, 0>, <1, 0, 0>} triangle {<0, 1, 0>, <1, 1, 0>, <1, 0, 0>}}
sphere {2 * x, 1}
plane {y, -1}
polygon {4, <0, 0>, <1, 0>, <0, 1>, <0, 0>}
EOS
check "open meshes, warnings for what has no mesh" exits 0 "$lambert" mesh mesh.pov -o two.ply
check "says what has no end" has err 'mesh.pov:5.*no end.*E0840'
check "says what has no inside" has err 'mesh.pov:6.*no inside.*E0840'
check "says how much" has err 'two.ply: 2 of 4 objects'
check "binary PLY" has two.ply 'format binary_little_endian'
check "binary STL" exits 0 "$lambert" mesh sphere.pov -o s.stl --mesh-resolution=8 -q
stl_whole() { triangles=$(od -An -tu4 -j80 -N4 s.stl | tr -d ' ') && test "$(wc -c <s.stl)" = $((84 + 50 * triangles)); }
check "of the length its head says" stl_whole
check "an unknown type is refused" exits 64 "$lambert" mesh sphere.pov -o s.xyz
check "nothing to mesh" exits 1 "$lambert" mesh /dev/null -o n.obj
echo old >keep.obj
echo 'sphere {0}' >wrong.pov
check "a scene with errors" exits 1 "$lambert" mesh wrong.pov -o keep.obj
check "leaves the file" has keep.obj old
finish
