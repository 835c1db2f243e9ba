// A gravity dam with a gallery on rock with a weak layer. Lengths in m.
//     gmsh -2 dam.geo -order 2 -format msh41 -o dam.msh
fine = 0.5; coarse = 4;

// The dam. Its upstream face, x = 0, in four parts for the pressure of the water.
Point(1) = {0, 0, 0, fine};    Point(2) = {15, 0, 0, fine};  Point(3) = {4, 15, 0, 1.4};
Point(4) = {4, 20, 0, 1.4};    Point(5) = {0, 20, 0, 1.4};   Point(6) = {0, 15, 0, 1.4};
Point(7) = {0, 10, 0, 1.2};    Point(8) = {0, 5, 0, 1};
Line(1) = {1, 2};              // the joint
Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5};
Line(5) = {5, 6}; Line(6) = {6, 7}; Line(7) = {7, 8}; Line(8) = {8, 1};
// The gallery.
Point(9) = {3, 2.5, 0, 0.4}; Point(10) = {4, 2.5, 0, 0.4}; Point(11) = {2, 2.5, 0, 0.4};
Circle(9) = {10, 9, 11}; Circle(10) = {11, 9, 10};
Curve Loop(1) = {1, 2, 3, 4, 5, 6, 7, 8}; Curve Loop(2) = {9, 10};
Plane Surface(1) = {1, 2};

// The rock, with a layer that dips downstream.
Point(12) = {-20, 0, 0, coarse};  Point(13) = {35, 0, 0, coarse};
Point(14) = {35, -6, 0, coarse};  Point(15) = {35, -9, 0, coarse}; Point(16) = {35, -20, 0, coarse};
Point(17) = {-20, -20, 0, coarse}; Point(18) = {-20, -4, 0, coarse}; Point(19) = {-20, -1.5, 0, 2};
Line(11) = {12, 1}; Line(12) = {2, 13}; Line(13) = {13, 14}; Line(14) = {14, 19}; Line(15) = {19, 12};
Line(16) = {14, 15}; Line(17) = {15, 18}; Line(18) = {18, 19};
Line(19) = {15, 16}; Line(20) = {16, 17}; Line(21) = {17, 18};
Curve Loop(3) = {11, 1, 12, 13, 14, 15}; Plane Surface(2) = {3};   // above the layer
Curve Loop(4) = {-14, 16, 17, 18};       Plane Surface(3) = {4};   // the layer
Curve Loop(5) = {-17, 19, 20, 21};       Plane Surface(4) = {5};   // below it

Physical Surface("dam") = {1};
Physical Surface("rock") = {2, 4};
Physical Surface("weak") = {3};
Physical Surface("ground") = {2, 3, 4};
Physical Curve("crest") = {4};
Physical Curve("water_4") = {5}; Physical Curve("water_3") = {6};
Physical Curve("water_2") = {7}; Physical Curve("water_1") = {8};
Physical Curve("reservoir") = {11};
Physical Curve("gallery") = {9, 10};
Physical Curve("bottom") = {20};
Physical Curve("sides") = {13, 15, 16, 18, 19, 21};
Mesh.RecombineAll = 1;
