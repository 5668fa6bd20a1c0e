Caligari V00.01ALH             
PolH V0.08 Id 1000 Parent 0 Size 00000700
Name roof
center 0 0 0
x axis 1 0 0
y axis 0 1 0
z axis 0 0 1
Transform
1 0 0 1
0 1 0 2
0 0 1 3
0 0 0 1
World Vertices 4
0 0 0
1 0 0
1 1 0
0 1 0.5
Texture Vertices 3
0 0
1 0
1 1
Faces 2
Face verts 3 flags 0 mat 0
<0,0> <1,1> <2,2>
Face verts 3 flags 0 mat 1
<0,0> <2,1> <3,2>
DrawFlags 0
Unit V0.01 Id 1001 Parent 1000 Size 00000009
Units 2
Mat1 V0.06 Id 1002 Parent 1000 Size 00000150
mat# 0
shader: phong  facet: auto32
rgb 0.8,0.2,0.1
alpha 1  ka 0.1  ks 0.1  exp 0  ior 1
texture: checks.gif
offset: 0,0  repeats: 1,1  flags: 2
Mat1 V0.06 Id 1003 Parent 1000 Size 00000080
mat# 1
shader: metal  facet: faceted
rgb 0.1,0.2,0.8
alpha 0.5  ka 0.1  ks 0.5  exp 0.5  ior 1
END  V1.00 Id 0 Parent 0 Size        0
