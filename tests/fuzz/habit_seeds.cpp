#include "tests/fuzz/habit_seeds.hpp"

#include <functional>
#include <map>

#include <fmt/format.h>

namespace hiac::fuzz {
namespace {

using Texts = std::vector<std::string>;

/// A brick beside a smaller one, and two elements of two processes.
Texts mfem() {
  const std::string refined =
      "MFEM NC mesh v1.0\n\ndimension\n3\n\nelements\n3\n0 4 5 1 1 2\n0 4 5 0 0 8 9 3 4 10 11 7\n"
      "0 6 5 0 8 1 2 9 10 5 6 11\n\nboundary\n0\n\nvertex_parents\n4\n8 0 1\n9 2 3\n10 4 5\n11 6 "
      "7\n"
      "\nroot_state\n1\n0\n\ncoordinates\n8\n3\n0 0 0\n2 0 0\n2 1 0\n0 1 0\n0 0 1\n2 0 1\n2 1 1\n"
      "0 1 1\n";
  const std::string ranks =
      "MFEM NC mesh v1.1\n\ndimension\n3\n\nrank\n1\n\nelements\n2\n0 1 4 0 0 1 2 3\n"
      "1 1 4 0 4 1 2 3\n\nboundary\n0\n\ncoordinates\n5\n3\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 1 1\n\n"
      "mfem_mesh_end\n";
  return {refined, ranks};
}

Texts nastran() {
  const std::string grids =
      "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,0.,1.,0.\nGRID,4,,0.,0.,1.\n";
  return {
      "BEGIN BULK\nSPC1,1,123,1\n=,*1,=,=\n=(2)\n" + grids +
          "FORCE,1,1,0,1.,0.,0.,1.\n=,=,*1,==\nCTETRA,1,1,1,2,3,4\nENDDATA\n",
      "BEGIN BULK\n" + grids + "CPENTA,1,1,1,2,3,4,4,4\nCHEXA,2,1,1,2,3,3,4,4,\n,4,4\nENDDATA\n"};
}

/// What keywords make: two rows of bricks, their mirror image, an arc. Sets of what is not there.
/// Cells that are collapsed.
Texts abaqus() {
  return {
      "*SYSTEM\n1,0,0,2,0,0\n*NODE,NSET=A\n1,0,0,0\n3,2,0,0\n*SYSTEM\n*NODE,SYSTEM=C\n"
      "31,2,90,0\n33,2,45,0\n*NGEN,NSET=F\n1,3\n*NGEN,LINE=C,NSET=G\n31,33,1,,0,0,0,0,0,-1\n"
      "*NGEN,LINE=P\n31,33,1,1\n*NFILL,NSET=L,BIAS=.5\nF,G,2,10\n*NSET,NSET=M,GENERATE\n"
      "1,40,1\n*NSET,NSET=U,UNSORTED\n3,1,L\n*NCOPY,CHANGE NUMBER=100,OLD SET=M,SHIFT\n"
      "0,0,1\n0,0,0,0,0,1,5\n*NCOPY,CHANGE NUMBER=200,OLD SET=M,REFLECT=MIRROR\n0,0,0,0,1,0\n"
      "0,0,1\n*ELEMENT,TYPE=C3D8,ELSET=E\n1,1,2,12,11,101,102,112,111\n*ELGEN,ELSET=E\n"
      "1,2,1,1,1,10,10,1,100,100\n*ELCOPY,OLD SET=E,ELEMENT SHIFT=10,SHIFT NODES=0,REFLECT\n",

      "*PART,NAME=P\n*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n*ELEMENT,TYPE=C3D4,ELSET=E\n"
      "1,1,2,3,4\n*END PART\n*ASSEMBLY,NAME=A\n*INSTANCE,NAME=I,PART=P\n*END INSTANCE\n"
      "*ELSET,ELSET=S,INSTANCE=GONE\n1,2,3\n*ELSET,ELSET=T,INSTANCE=I\n1\n"
      "*NSET,NSET=N,INSTANCE=GONE\n1,2\n*SURFACE,NAME=F\nS,S1\n*END ASSEMBLY\n",
      "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n*ELEMENT,TYPE=C3D6\n1,1,2,3,4,4,4\n"
      "*ELEMENT,TYPE=C3D8\n2,1,2,3,3,4,4,4,4\n"};
}

/// Values of nodes that are not there.
Texts frd() {
  const auto node = [](int number, double x, double y, double z) {
    return fmt::format(" -1{:10}{:12.5E}{:12.5E}{:12.5E}\n", number, x, y, z);
  };
  std::string values;
  for (const int n : {1, 2, 7, 3, 4, 9}) values += fmt::format(" -1{:10}{:12.5E}\n", n, 10.0 * n);
  return {
      "    1C\n    2C                             4                                     1\n" +
      node(1, 0, 0, 0) + node(2, 1, 0, 0) + node(3, 0, 1, 0) + node(4, 0, 0, 1) +
      " -3\n    3C                             1                                     1\n" +
      fmt::format(" -1{:10}{:5}{:5}{:5}\n -2{:10}{:10}{:10}{:10}\n -3\n", 1, 3, 0, 1, 1, 2, 3, 4) +
      "    1PSTEP                         1           1           1\n"
      "  100CL  101 1.000000000           6                     0    1           1\n"
      " -4  NDTEMP      1    1\n -5  T           1    1    0    0\n" +
      values + " -3\n 9999\n"};
}

/// Decks without blocks, as Ansys writes them and as users do; a tetrahedron of ten places, of
/// which the last ones are not written.
Texts ansys() {
  std::string text =
      "/PREP7\nET,1,187\nN,1,0,0,0\nN,2,1,0,0\nN,3,0,1,0\nN,4,0,0,1\nN,5,.5,0,0\n"
      "EBLOCK,19,SOLID\n(19i9)\n";
  for (const int field : {1, 1, 1, 1, 0, 0, 0, 0, 6, 0, 1, 1, 2, 3, 4, 5, 0})
    text += fmt::format("{:9}", field);
  return {
      "/PREP7\nET,1,187\nET,2,185\nN,R5.3,LOC,1,0,0,0.,0.,0.\nN,R5.3,ANG,1,0,0,5.\n"
      "N,R5.3,LOC,2,0,0,1.\nN,R5.3,LOC,3,0,0,0.,1.\nN,R5.3,LOC,4,0,0,0.,0.,1.\n"
      "N,R5.3,LOC,-1,\nEN,R5.5,ATTR,10,1,1,1,0,0,7,0,0,0\nEN,R5.5,NODE,1,2,3,4,0,0,0,0,\n"
      "EN,R5.5,NODE,0,0\nEN,R5.5,ATTR,8,1,2,1,0,0,8\nEN,R5.5,NODE,1,2,3,3,4,4,4,4\n",
      "/PREP7\nET,3,SOLID185\nTYPE,3\nN,1 $ NGEN,2,1,1,,,1.\nNGEN,2,10,1,2,1,0,1 ! y\n"
      "NGEN,2,100,ALL,,,0,0,1\nCSYS,1\nN,200,1,45,2\nCSYS,2\nN,,3,90,45\nE,1,2,12,11,101,102,"
      "112,111\nEGEN,2,0,-1\nEN,9,1,2,12,11,101,102,112,200\nET,4,186\nTYPE,4\n"
      "E,1,2,12,11,101,102,112,111\nEMORE,0,0\nEMORE,0\n",
      text + "\n-1\n"};
}

/// MSH of version 3.
Texts gmsh() {
  return {
      "$MeshFormat\n3 0 8\n$EndMeshFormat\n$Entities\n1 0 1 1\n1 0 \n1 1 -2 0\n5 1 1 2 6 8\n"
      "$EndEntities\n$Nodes\n4\n1 0 0 0 0\n2 1 0 0 1 1 .5\n3 0 1 0 1 2 .1 .2\n"
      "4 0 0 1 5 3 0 0 1\n$EndNodes\n$Elements\n2\n1 4 5 6 1 2 3 4 1 2\n2 2 1 3 1 2 3\n"
      "$EndElements\n"};
}

}  // namespace

std::vector<std::string> habit_seeds(const std::string& format) {
  static const std::map<std::string, std::function<Texts()>> known{
      {"abaqus", abaqus}, {"ansys", ansys}, {"frd", frd},
      {"gmsh", gmsh},     {"mfem", mfem},   {"nastran", nastran}};
  const auto found = known.find(format);
  return found == known.end() ? Texts{} : found->second();
}

}  // namespace hiac::fuzz
