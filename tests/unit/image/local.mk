# tests of unit/image
