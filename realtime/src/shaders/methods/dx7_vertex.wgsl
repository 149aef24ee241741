// title: fake refraction, per vertex
// alias: M1a
// citation: @misc{FakeRefraction2000,
//   title = {Approximating Refraction: Fake Refraction in DX7},
//   year = {2000},
//   note = {cube maps indexed by R = (1 - a)(N.E)N - E}
// }
// needs: interpolated
// at vertices: vertex_dx7
// bends at equal index
// one way for all colours
// The reflection formula with another factor, per vertex, interpolated without
// normalising. With the printed 1/n light bends the wrong way; triangles show. Beside the
// exact image the sky stands upright in the upper half of a ball where it should hang
// below, and bands follow the triangles.
