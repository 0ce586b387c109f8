# tests of unit/eval
