// A value on the heap that is copied with its owner. Headers that hold a Boxed<T> need not know T, so that a
// change of T rebuilds those alone who look inside.
//
// T's own header says `extern template class Boxed<T>;`, and its source instantiates it.
#pragma once

#include <concepts>
#include <utility>

namespace shoal {

template <typename T>
class Boxed {
  public:
    Boxed();
    Boxed(const Boxed& other);
    Boxed(Boxed&& other) noexcept : value_(std::exchange(other.value_, nullptr)) {}
    Boxed& operator=(Boxed other) noexcept {
        std::swap(value_, other.value_);
        return *this;
    }
    ~Boxed();
    template <typename U>
    requires(!std::same_as<U, Boxed>) Boxed(U value);

    // Not of a box that was moved from.
    T& operator*() { return *value_; }
    const T& operator*() const { return *value_; }
    T* operator->() { return value_; }
    const T* operator->() const { return value_; }

  private:
    T* value_;
};

template <typename T>
Boxed<T>::Boxed() : value_(new T()) {}

template <typename T>
template <typename U>
requires(!std::same_as<U, Boxed<T>>) Boxed<T>::Boxed(U value) : value_(new T(std::move(value))) {}

template <typename T>
Boxed<T>::Boxed(const Boxed& other) : value_(new T(*other)) {}

template <typename T>
Boxed<T>::~Boxed() {
    delete value_;
}

}  // namespace shoal
