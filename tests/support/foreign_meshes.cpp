#include "support/foreign_meshes.h"

#include <cerrno>

#include <sys/syscall.h>
#include <unistd.h>

#include "support/mesh_io.h"

namespace ibmfair::test {

namespace {

std::string reals(const std::vector<double>& values) {
  std::string bytes;
  for (const double value : values) {
    bytes += to_bytes(value, 4, false, true);
  }
  return bytes;
}

std::string integers(const std::vector<int>& values, int size) {
  std::string bytes;
  for (const int value : values) {
    bytes += to_bytes(value, size, false, false);
  }
  return bytes;
}

std::string stl() {
  return std::string(80, '\0') + integers({1}, 4) + reals({0, 0, 1}) + triangle_buffer() +
         integers({0}, 2);
}

std::string threeds() {
  const auto chunk = [](int id, const std::string& contents) {
    return integers({id}, 2) + integers({6 + static_cast<int>(contents.size())}, 4) + contents;
  };
  const std::string vertices = chunk(0x4110, integers({3}, 2) + triangle_buffer());
  const std::string faces = chunk(0x4120, integers({1, 0, 1, 2, 7}, 2));
  const std::string object = chunk(0x4000, std::string("a\0", 2) + chunk(0x4100, vertices + faces));
  return chunk(0x4d4d, chunk(0x3d3d, object));
}

std::string glb() {
  std::string text = triangle_gltf("");
  text.erase(text.find(R"(,"uri":"")"), 9);
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const std::string buffer = triangle_buffer();
  const auto chunk = [](const std::string& type, const std::string& contents) {
    return integers({static_cast<int>(contents.size())}, 4) + type + contents;
  };
  const std::string chunks = chunk("JSON", text) + chunk(std::string("BIN\0", 4), buffer);
  return "glTF" + integers({2, 12 + static_cast<int>(chunks.size())}, 4) + chunks;
}

std::string amf() {
  std::string vertices;
  for (const std::string at : {"<x>0</x><y>0</y>", "<x>1</x><y>0</y>", "<x>0</x><y>1</y>"}) {
    vertices += "<vertex><coordinates>" + at + "<z>0</z></coordinates></vertex>";
  }
  return "<?xml version='1.0'?><amf unit='inch'><object id='0'><mesh><vertices>" + vertices +
         "</vertices><volume><triangle><v1>0</v1><v2>1</v2><v3>2</v3></triangle></volume></mesh>"
         "</object></amf>";
}

constexpr const char* ac = R"(AC3Db
MATERIAL "" rgb 1 1 1 amb 1 1 1 emis 0 0 0 spec 0 0 0 shi 0 trans 0
OBJECT world
kids 1
OBJECT poly
numvert 3
0 0 0
1 0 0
0 1 0
numsurf 1
SURF 0x20
mat 0
refs 3
0 0 0
1 1 0
2 0 1
kids 0
)";

constexpr const char* ase = R"(*3DSMAX_ASCIIEXPORT 200
*GEOMOBJECT {
*NODE_NAME "a"
*MESH {
*MESH_NUMVERTEX 3
*MESH_NUMFACES 1
*MESH_VERTEX_LIST {
*MESH_VERTEX 0 0 0 0
*MESH_VERTEX 1 1 0 0
*MESH_VERTEX 2 0 1 0
}
*MESH_FACE_LIST {
*MESH_FACE 0: A: 0 B: 1 C: 2 AB: 1 BC: 1 CA: 1
}
}
}
)";

constexpr const char* collada = R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><up_axis>Z_UP</up_axis></asset>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="a" count="9">0 0 0 1 0 0 0 1 0</float_array><technique_common>
<accessor source="#a" count="3" stride="3"><param name="X" type="float"/>
<param name="Y" type="float"/><param name="Z" type="float"/></accessor>
</technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node><instance_geometry url="#g"/></node>
</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>
)";

constexpr const char* dxf =
    "0\nSECTION\n2\nENTITIES\n0\n3DFACE\n8\n0\n10\n0\n20\n0\n30\n0\n11\n1\n21\n0\n31\n0\n12\n0\n"
    "22\n1\n32\n0\n13\n0\n23\n1\n33\n0\n0\nENDSEC\n0\nEOF\n";

constexpr const char* fbx = R"(; FBX 7.3.0 project file
FBXHeaderExtension:  {
FBXHeaderVersion: 1003
FBXVersion: 7300
}
GlobalSettings:  {
Version: 1000
}
Objects:  {
Geometry: 1, "Geometry::g", "Mesh" {
Vertices: *9 {
a: 0,0,0,1,0,0,0,1,0
}
PolygonVertexIndex: *3 {
a: 0,1,-3
}
GeometryVersion: 124
}
Model: 2, "Model::m", "Mesh" {
Version: 232
}
}
Connections:  {
C: "OO",2,0
C: "OO",1,2
}
)";

constexpr const char* nff = R"(v
from 0 0 1
at 0 0 0
up 0 1 0
angle 45
hither 1
resolution 8 8
b 0 0 0
f 1 1 1 1 0 0 0 0
p 3
0 0 0
1 0 0
0 1 0
)";

constexpr const char* smd = R"(version 1
nodes
0 "r" -1
end
skeleton
time 0
0 0 0 0 0 0 0
end
triangles
m
0 0 0 0 0 0 1 0 0
0 1 0 0 0 0 1 1 0
0 0 1 0 0 0 1 0 1
end
)";

constexpr const char* direct_x =
    "xof 0303txt 0032\nMesh m {\n3;\n0;0;0;,\n1;0;0;,\n0;1;0;;\n1;\n3;0,1,2;;\n}\n";

constexpr const char* x3d =
    "<X3D version='3.0'><Scene><Shape><IndexedFaceSet coordIndex='0 1 2 -1'>"
    "<Coordinate point='0 0 0 1 0 0 0 1 0'/></IndexedFaceSet></Shape></Scene></X3D>";

}  // namespace

const char* const triangle_data_uri =
    "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";

std::string triangle_buffer() {
  return reals({0, 0, 0, 1, 0, 0, 0, 1, 0});
}

std::string triangle_gltf(const std::string& uri) {
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],
"bufferViews":[{"buffer":0,"byteLength":36}],
"buffers":[{"byteLength":36,"uri":")" +
         uri + R"("}]})";
}

std::vector<ForeignMesh> foreign_triangles() {
  return {{"stl", stl()}, {"3ds", threeds()}, {"gltf", triangle_gltf(triangle_data_uri)},
          {"glb", glb()}, {"dae", collada},   {"fbx", fbx},
          {"amf", amf()}, {"x3d", x3d},       {"ac", ac},
          {"ase", ase},   {"dxf", dxf},       {"nff", nff},
          {"smd", smd},   {"x", direct_x}};
}

bool imports_can_refer_to_files() {
  // If the system call exists, it fails because of its arguments, not with ENOSYS.
  return syscall(SYS_openat2, -1, "", nullptr, 0) >= 0 || errno != ENOSYS;
}

}  // namespace ibmfair::test
