// How Assimp opens a model and what it names (materials, buffers): only what may be opened (core/sandbox.h).
#pragma once

#include <assimp/DefaultIOSystem.h>

#include "core/sandbox.h"

namespace shoal {

class ModelFiles : public Assimp::DefaultIOSystem {
  public:
    bool Exists(const char* file) const override {
        return mayOpen(file) && Assimp::DefaultIOSystem::Exists(file);
    }
    Assimp::IOStream* Open(const char* file, const char* mode) override {
        return mayOpen(file) ? Assimp::DefaultIOSystem::Open(file, mode) : nullptr;
    }
};

}  // namespace shoal
