#declare A = array[4] {1, 2, 3, 4}
#declare B = A[1e10];
#declare A[1e999] = 2;
#declare A[-1e30] = 2;
#declare A[0/0] = 2;
sphere { 0, A[3e9] }
