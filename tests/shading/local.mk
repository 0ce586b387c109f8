# tests of shading
