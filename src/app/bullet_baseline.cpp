#include "app/bullet_baseline.h"

#ifdef SHOAL_HAS_BULLET

#include <BulletSoftBody/btSoftBody.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace shoal {

namespace {

constexpr double gamma = 1;  // 1/s
const btVector3 gravity(0, -9.81f, 0), wind(2, 0, 0.5f);

struct BulletWorld : BulletBaseline {
    BulletWorld(const Molecule& molecule, int count, bool merged) {
        // Wind and drag are dv/dt = gamma (u - v): a constant part here, the other in frame().
        const btVector3 constant = gravity + wind * btScalar(gamma);
        world.setGravity(constant);
        info.m_broadphase = &broadphase;
        info.m_dispatcher = &dispatcher;
        info.m_gravity = constant;
        info.air_density = 0;
        info.m_sparsesdf.Initialize();
        groundBody.setFriction(0.5f);
        groundBody.setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(0, -50, 0)));
        world.addRigidBody(&groundBody);
        const int side = std::max(1, int(std::ceil(std::sqrt(double(count)))));
        const double spacing = 1.5 * molecule.size();
        std::vector<btVector3> positions;
        std::vector<btScalar> masses;
        for (int m = 0; m < count; ++m) {
            const int row = m / side;
            const glm::dvec3 place(m % side * spacing, 0.2 + molecule.size() + 5.8 * m / count,
                                   row * spacing);
            for (const Vertex& vertex : molecule.vertices) {
                const glm::dvec3 p = place + vertex.position;
                positions.emplace_back(btScalar(p.x), btScalar(p.y), btScalar(p.z));
                masses.push_back(btScalar(vertex.mass));
            }
            if (merged && m + 1 < count) continue;
            add(positions, masses, molecule.springs, molecule.vertices.size());
            positions.clear();
            masses.clear();
        }
    }
    ~BulletWorld() override {
        for (const auto& body : bodies)
            world.removeSoftBody(body.get());
        world.removeRigidBody(&groundBody);
    }

    void frame(double seconds) override {
        for (const auto& body : bodies)
            body->m_cfg.kDP = btScalar(-std::expm1(-gamma * seconds));
        world.stepSimulation(btScalar(seconds), 0);
        info.m_sparsesdf.GarbageCollect();
    }

    void add(const std::vector<btVector3>& positions, const std::vector<btScalar>& masses,
             const std::vector<Spring>& springs, size_t vertexCount) {
        bodies.push_back(
            std::make_unique<btSoftBody>(&info, int(positions.size()), positions.data(), masses.data()));
        btSoftBody& body = *bodies.back();
        for (size_t first = 0; first < positions.size(); first += vertexCount) {
            for (const Spring& spring : springs)
                body.appendLink(int(first) + spring.a, int(first) + spring.b);
        }
        body.m_cfg.piterations = 1;
        body.m_cfg.collisions = btSoftBody::fCollision::SDF_RS;  // with the ground only
        body.m_cfg.kDF = 0.5f;
        body.getCollisionShape()->setMargin(0.002f);
        world.addSoftBody(&body, btBroadphaseProxy::DefaultFilter, btBroadphaseProxy::StaticFilter);
    }

    btSoftBodyRigidBodyCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher{&configuration};
    btDbvtBroadphase broadphase;
    btSequentialImpulseConstraintSolver solver;
    btSoftRigidDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
    // Soft bodies collide with convex shapes only, through a signed distance: no plane. That distance is
    // found in floats by iteration, and fails with a box of kilometres.
    btBoxShape ground{btVector3(200, 50, 200)};
    btRigidBody groundBody{btRigidBody::btRigidBodyConstructionInfo(0, nullptr, &ground)};
    btSoftBodyWorldInfo info;
    std::vector<std::unique_ptr<btSoftBody>> bodies;
};

}  // namespace

bool bulletAvailable() {
    return true;
}

std::unique_ptr<BulletBaseline> makeBullet(const Molecule& molecule, int count, bool merged) {
    return std::make_unique<BulletWorld>(molecule, count, merged);
}

}  // namespace shoal

#else

namespace shoal {

bool bulletAvailable() {
    return false;
}

std::unique_ptr<BulletBaseline> makeBullet(const Molecule&, int, bool) {
    return nullptr;
}

}  // namespace shoal

#endif
