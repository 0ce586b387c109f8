# tests of unit/scene
