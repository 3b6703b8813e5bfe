// Hot pool of a pool-type reactor, 1:10 laboratory model: one half (y >= 0) of the vessel.
// Lengths in metres; z = 0 is the top of the core, z = surface_z the free surface.
//   gmsh -3 -format msh22 -o pool.msh pool.geo
SetFactory("OpenCASCADE");

vessel_r  = 1.00;   surface_z = 0.85;   // cylindrical vessel up to the free surface
bottom_r  = 1.50;   bottom_z  = -0.50;  // spherical bottom: radius and lowest point
core_r    = 0.45;                       // core barrel, z <= 0
jet_r     = 0.10;   jet_pitch = 0.27;   // seven outlets of the core in a hexagon
plug_r    = 0.40;   plug_z    = 0.55;   // above-core structure hanging from the roof
ihx_r     = 0.18;   ihx_z     = 0.02;   // intermediate heat exchangers: outer radius, mouth
bore_r    = 0.15;   bore_top  = 0.40;   // their bore, through which the coolant leaves
ihx_ring  = 0.73;                       // radius of the circle of their axes
pump_r    = 0.13;   pump_ring = 0.75;   // pump: a closed column from bottom to surface

// The fluid: vessel minus core, plug, exchangers and pump, plus the bores.
Cylinder(1) = {0, 0, -1, 0, 0, 1 + surface_z, vessel_r};
Sphere(2) = {0, 0, bottom_z + bottom_r, bottom_r};
BooleanIntersection(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
Cylinder(4) = {0, 0, -1, 0, 0, 1, core_r};
Cylinder(5) = {0, 0, plug_z, 0, 0, 1, plug_r};
Cylinder(6) = {0, pump_ring, -1, 0, 0, 3, pump_r};
ihx_x = ihx_ring * Cos(Pi/4);  ihx_y = ihx_ring * Sin(Pi/4);
Cylinder(7) = { ihx_x, ihx_y, ihx_z, 0, 0, 1, ihx_r};
Cylinder(8) = {-ihx_x, ihx_y, ihx_z, 0, 0, 1, ihx_r};
Cylinder(9)  = { ihx_x, ihx_y, ihx_z, 0, 0, bore_top - ihx_z, bore_r};
Cylinder(10) = {-ihx_x, ihx_y, ihx_z, 0, 0, bore_top - ihx_z, bore_r};
BooleanDifference(11) = { Volume{7}; Delete; }{ Volume{9}; Delete; };
BooleanDifference(12) = { Volume{8}; Delete; }{ Volume{10}; Delete; };
BooleanDifference(13) = { Volume{3}; Delete; }{ Volume{4, 5, 6, 11, 12}; Delete; };
Box(14) = {-2, 0, -2, 4, 2, 4};
BooleanIntersection(20) = { Volume{13}; Delete; }{ Volume{14}; Delete; };

// The seven outlets of the core, imprinted on its top (two of them lie behind the cut).
Disk(1001) = {0, 0, 0, jet_r};
For k In {0:5}
  Disk(1002 + k) = {jet_pitch*Cos(k*Pi/3), jet_pitch*Sin(k*Pi/3), 0, jet_r};
EndFor
Rectangle(1010) = {-1, 0, 0, 2, 1};
jets() = BooleanIntersection{ Surface{1001:1007}; Delete; }{ Surface{1010}; Delete; };
BooleanFragments{ Volume{20}; Delete; }{ Surface{jets()}; Delete; }

e = 1e-3;
inlet() = {};
For k In {-1:5}
  r = (k < 0) ? 0 : jet_pitch;
  inlet() += Surface In BoundingBox{r*Cos(k*Pi/3) - jet_r - e, r*Sin(k*Pi/3) - jet_r - e, -e,
                                    r*Cos(k*Pi/3) + jet_r + e, r*Sin(k*Pi/3) + jet_r + e, e};
EndFor
outlet()   = Surface In BoundingBox{-1, 0, bore_top - e, 1, 1, bore_top + e};
symmetry() = Surface In BoundingBox{-1 - e, -e, -1, 1 + e, e, 1};
surface()  = Surface In BoundingBox{-1 - e, -e, surface_z - e, 1 + e, 1 + e, surface_z + e};
wall() = Boundary{ Volume{:}; };
wall() = Abs(wall());
wall() -= {inlet(), outlet(), symmetry(), surface()};

Physical Volume("fluid", 10) = {Volume{:}};
Physical Surface("wall", 1) = wall();
Physical Surface("inlet", 2) = inlet();
Physical Surface("outlet", 3) = outlet();
Physical Surface("symmetry", 4) = symmetry();
Physical Surface("surface", 5) = surface();

// Size of the elements: fine in the jets, then in the bores, at the columns and in the sheet of
// coolant that spreads from the plug, coarse elsewhere.
h_jet = 0.053;  h_bore = 0.068;  h_column = 0.070;  h_sheet = 0.095;  h_bulk = 0.140;
Macro FineCylinder // field `f`: size `h` within the upright cylinder of axis (cx, cy)
  Field[f] = Cylinder;
  Field[f].XCenter = cx;  Field[f].YCenter = cy;  Field[f].ZCenter = (z0 + z1)/2;
  Field[f].XAxis = 0;  Field[f].YAxis = 0;  Field[f].ZAxis = (z1 - z0)/2 + e;
  Field[f].Radius = r + e;  Field[f].VIn = h;  Field[f].VOut = h_bulk;
Return
f = 1;  h = h_jet;  cx = 0;  cy = 0;  r = core_r;  z0 = 0;  z1 = plug_z;  Call FineCylinder;
f = 2;  h = h_sheet;  r = 0.75;  z0 = plug_z - 0.2;  z1 = plug_z + 0.1;  Call FineCylinder;
f = 3;  h = h_column;  cy = pump_ring;  r = pump_r;  z0 = -1;  z1 = 1;  Call FineCylinder;
cx = ihx_x;  cy = ihx_y;
f = 4;  r = ihx_r;  z0 = ihx_z;  Call FineCylinder;
f = 5;  h = h_bore;  r = bore_r;  z0 = -0.05;  z1 = bore_top;  Call FineCylinder;
cx = -ihx_x;
f = 6;  h = h_column;  r = ihx_r;  z0 = ihx_z;  z1 = 1;  Call FineCylinder;
f = 7;  h = h_bore;  r = bore_r;  z0 = -0.05;  z1 = bore_top;  Call FineCylinder;
Field[10] = Min;
Field[10].FieldsList = {1:7};
Background Field = 10;
Mesh.CharacteristicLengthExtendFromBoundary = 0;
Mesh.CharacteristicLengthFromPoints = 0;
Mesh.Algorithm = 6;
Mesh.Algorithm3D = 1;
Mesh.Optimize = 1;
