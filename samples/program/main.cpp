// first_picture MESH.zoo PICTURE.png: a picture of a mesh from a view that shows all of it.
#include <exception>
#include <iostream>

#include "hiac/image/image_io.hpp"
#include "hiac/mesh/zoo_container.hpp"
#include "hiac/scene/specification.hpp"
#include "hiac/session/session.hpp"

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: first_picture MESH.zoo PICTURE.png\n";
    return 2;
  }
  try {
    hiac::Session session(hiac::read_zoo_file(argv[1]).mesh);
    hiac::Scene scene = hiac::starter_view(session.mesh(), argv[1]);
    scene.image = {640, 480};
    session.require_drawable(scene);
    const hiac::Picture picture = session.picture(scene);
    hiac::write_image(argv[2], picture.image,
                      {.background_included = true,
                       .attributes = {{"hiac:specification", hiac::to_toml(scene)}}});
    std::cout << picture.segments << " ray segments in " << picture.covered_pixels
              << " pixels, mean optical depth " << picture.mean_optical_depth << '\n';
    return picture.covered_pixels > 0 ? 0 : 1;
  } catch (const std::exception& error) {
    std::cerr << "first_picture: " << error.what() << '\n';
    return 3;
  }
}
