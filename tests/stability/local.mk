# tests of stability
