// verlet: Verlet's position form [Latta 2004, (9)], order 1 because its first step back is v h.
//   x' = x + (x - x_before) + h^2 a, with drag and gravity exact over h and the springs' part of h^2 a bounded: a spring
//   is a distance constraint [Latta 2004, section 3.4.3], [Jakobsen 2001] that moves its ends by the share k h^2 (1/m_i + 1/m_j) of the
//   way to its rest length, at most all of it (physics/spring.glsl, through VERLET in the springs' text).
//   A collider is a constraint on the position as well (constrain in physics/collide.glsl): what entered is moved out.
//   v = (x' - x) / h: what is left of it after positions are rounded.
#include "solver/euler.glsl"
