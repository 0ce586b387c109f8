# tests of unit/lang
