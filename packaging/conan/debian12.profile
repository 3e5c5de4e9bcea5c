# The libraries of Debian 12 in place of packages of Conan: scripts/install_dependencies installs them.
include(default)

[platform_requires]
onetbb/2021.8.0
highway/1.0.3
assimp/5.2.5
pugixml/1.13
minizip/1.1
zlib/1.2.13
cgal/5.5.1
gmp/6.2.1
mpfr/4.2.0
xxhash/0.8.1
nlohmann_json/3.11.2
libtiff/4.5.0
cli11/2.1.2
libpng/1.6.39
isa-l/2.30.0
