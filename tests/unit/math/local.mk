# tests of unit/math
