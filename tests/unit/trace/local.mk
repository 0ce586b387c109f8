# tests of unit/trace
