// The C++ layer: every class and call once, exceptions both ways, copies and moves. A file a subject.
#include "subjects.hpp"

#include <cstdio>

int main() {
    urdf();
    srdf();
    scenes();
    bodies();
    octrees();
    hierarchies();
    poses();
    euler_angles();
    robots();
    spaces();
    steps();
    queries();
    sets();
    std::puts("the C++ layer holds");
}
