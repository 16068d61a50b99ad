// An e-puck with infrared sensors and camera among four boxes; prints the CPU seconds of the steps asked for.
#include <cstdlib>
#include <ctime>
#include <iostream>
#include <enki/PhysicalEngine.h>
#include <enki/robots/e-puck/EPuck.h>

int main(int argc, char **argv) {
    const long steps = argc > 1 ? std::atol(argv[1]) : 1000;
    Enki::World world(400, 400);  // cm
    const double boxes[4][2] = {{120, 280}, {280, 120}, {25, 100}, {375, 300}};
    for (const auto &place : boxes) {
        auto *box = new Enki::PhysicalObject;
        box->setRectangular(50, 50, 50, -1);  // a negative mass does not move
        box->pos = Enki::Point(place[0], place[1]);
        world.addObject(box);
    }
    auto *robot = new Enki::EPuck(Enki::EPuck::CAPABILITY_BASIC_SENSORS | Enki::EPuck::CAPABILITY_CAMERA);
    robot->pos = Enki::Point(200, 200);
    world.addObject(robot);
    const std::clock_t started = std::clock();
    for (long i = 0; i < steps; ++i) {
        robot->leftSpeed = 10 + std::rand() % 4;
        robot->rightSpeed = 10 + std::rand() % 4;
        world.step(0.1565);
    }
    std::cout << double(std::clock() - started) / CLOCKS_PER_SEC << std::endl;
}
