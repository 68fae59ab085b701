// M + rho J^T D J, body by body and contact by contact.
#include "solver/newton/island_laws.h"
#include "solver/newton/newton_method.h"

namespace plumb::inline PLUMB_ABI::detail::newton {
namespace {

using Matrix3d = double[3][3];

void copy(const Sym3d& s, Matrix3d m) {
  m[0][0] = s.xx;
  m[1][1] = s.yy;
  m[2][2] = s.zz;
  m[0][1] = m[1][0] = s.xy;
  m[0][2] = m[2][0] = s.xz;
  m[1][2] = m[2][1] = s.yz;
}
void multiply(const Matrix3d a, const Matrix3d b, Matrix3d out) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      out[i][j] = a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j];
}
void multiply_turned(const Matrix3d a, const Matrix3d b, Matrix3d out) {  // a^T b
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      out[i][j] = a[0][i] * b[0][j] + a[1][i] * b[1][j] + a[2][i] * b[2][j];
}
// F^T m F with the rows n, t1, t2 of F.
void turn_to_world(const Matrix3d F, Matrix3d m) {
  Matrix3d half;
  multiply(m, F, half);
  multiply_turned(F, half, m);
}

// What a contact resists, in the frame at its centre: [uu uw; uw^T ww].
struct Resistance {
  Matrix3d uu = {}, uw = {}, ww = {};
};

void add_point(const IslandPoint& p, const Sym3d& D, Resistance& r) {
  Matrix3d d;
  copy(D, d);
  const Matrix3d B = {{0, p.b, -p.a}, {-p.b, 0, 0}, {p.a, 0, 0}};
  Matrix3d dB, BdB;
  multiply(d, B, dB);
  multiply_turned(B, dB, BdB);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      r.uu[i][j] += d[i][j];
      r.uw[i][j] += dB[i][j];
      r.ww[i][j] += BdB[i][j];
    }
}

// Velocity at the centre from that of a body: u = v - [arm] w.
void arm_matrix(Vec3d r, Matrix3d X) {
  const Matrix3d m = {{0, r.z, -r.y}, {-r.z, 0, r.x}, {r.y, -r.x, 0}};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) X[i][j] = m[i][j];
}

// [1 Xa; 0 1]^T r [1 Xb; 0 1], times a sign.
void place(const Resistance& r, const Matrix3d Xa, const Matrix3d Xb, double sign, Block6& out) {
  Matrix3d right, top, turned, bottom;
  multiply(r.uu, Xb, right);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) right[i][j] += r.uw[i][j];  // uu Xb + uw
  multiply_turned(Xa, r.uu, top);                           // Xa^T uu
  multiply_turned(Xa, right, bottom);                       // Xa^T (uu Xb + uw)
  multiply_turned(r.uw, Xb, turned);                        // uw^T Xb
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      out.at[i][j] = sign * r.uu[i][j];
      out.at[i][j + 3] = sign * right[i][j];
      out.at[i + 3][j] = sign * (top[i][j] + r.uw[j][i]);
      out.at[i + 3][j + 3] = sign * (bottom[i][j] + turned[i][j] + r.ww[i][j]);
    }
}

Vec3d along(Vec3d a, Vec3d b) { return multiply_each(a, b); }
// Takes out what a body cannot do: rows if `rows`, else columns.
void restrict_block(const IslandBody& body, bool rows, Block6& m) {
  if (!body.restricted) return;
  for (int k = 0; k < 6; ++k) {
    double* at[6];
    for (int i = 0; i < 6; ++i) at[i] = rows ? &m.at[i][k] : &m.at[k][i];
    const Vec3d v = along(body.moves, {*at[0], *at[1], *at[2]});
    const Vec3d w = body.turns * Vec3d{*at[3], *at[4], *at[5]};
    *at[0] = v.x, *at[1] = v.y, *at[2] = v.z, *at[3] = w.x, *at[4] = w.y, *at[5] = w.z;
  }
}

void add_to(Block6& to, const Block6& m) {
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) to.at[i][j] += m.at[i][j];
}

void add_block(Island& island, int i, int j, Block6& m) {
  restrict_block(island.bodies[static_cast<std::size_t>(i)], true, m);
  restrict_block(island.bodies[static_cast<std::size_t>(j)], false, m);
  const std::uint32_t a = static_cast<std::uint32_t>(i), b = static_cast<std::uint32_t>(j);
  if (a == b) {
    add_to(island.matrix.diagonal(a), m);
  } else {
    island.matrix.add(a, b, m);
  }
}

void add_contact(Island& island, const IslandContact& c, double rho) {
  Resistance r;
  for (int i = 0; i < c.count; ++i) add_point(c.points[i], c.points[i].D, r);
  if (c.resists_turning) {
    Matrix3d d;
    copy(c.turn_D, d);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) r.ww[i][j] += d[i][j];
  }
  const Matrix3d F = {{c.n.x, c.n.y, c.n.z}, {c.t1.x, c.t1.y, c.t1.z}, {c.t2.x, c.t2.y, c.t2.z}};
  for (auto* m : {&r.uu, &r.uw, &r.ww}) {
    turn_to_world(F, *m);
    for (auto& row : *m)
      for (double& x : row) x *= rho;
  }
  Matrix3d Xa, Xb;
  arm_matrix(c.arm_a, Xa);
  arm_matrix(c.arm_b, Xb);
  Block6 m;
  if (c.a != kFixed) {
    place(r, Xa, Xa, 1, m);
    add_block(island, c.a, c.a, m);
  }
  if (c.b != kFixed) {
    place(r, Xb, Xb, 1, m);
    add_block(island, c.b, c.b, m);
  }
  if (c.a != kFixed && c.b != kFixed) {
    place(r, Xa, Xb, -1, m);
    add_block(island, c.a, c.b, m);
  }
}

// m += k x y^T
void add_outer(double k, const Twist& x, const Twist& y, Block6& m) {
  const double a[6] = {x.v.x, x.v.y, x.v.z, x.w.x, x.w.y, x.w.z};
  const double b[6] = {y.v.x, y.v.y, y.v.z, y.w.x, y.w.y, y.w.z};
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) m.at[i][j] += k * a[i] * b[j];
}

void add_joint(Island& island, const IslandJoint& joint, double rho) {
  double D[kMaxJointRows][kMaxJointRows] = {};
  for (std::uint32_t k = joint.first_law; k < joint.first_law + joint.laws; ++k) {
    const ScalarLaw& law = island.laws[k];
    D[law.row][law.row] += rho * law.D;
  }
  for (int b = 0; b < joint.balls; ++b) {
    const int first = island.laws[static_cast<std::size_t>(joint.ball[b].first)].row;
    for (int e = 0; e < 3; ++e) {
      const int i = first + (e == 2 ? 1 : 0), j = first + (e == 0 ? 1 : 2);
      D[i][j] += rho * joint.ball_D[b][e];
      D[j][i] += rho * joint.ball_D[b][e];
    }
  }
  for (int p = 0; p < joint.bodies; ++p)
    for (int q = p; q < joint.bodies; ++q) {
      if (joint.body[p] == kFixed || joint.body[q] == kFixed) continue;
      Block6 m{};
      for (int i = 0; i < joint.rows; ++i)
        for (int j = 0; j < joint.rows; ++j)
          if (D[i][j] != 0) add_outer(D[i][j], joint.J[i][p], joint.J[j][q], m);
      add_block(island, joint.body[p], joint.body[q], m);
    }
}

}  // namespace

void assemble(Island& island) {
  const double rho = island.step_length * island.mass;
  island.matrix.clear();
  for (std::size_t i = 0; i < island.bodies.size(); ++i) {
    const IslandBody& body = island.bodies[i];
    Block6& m = island.matrix.diagonal(static_cast<std::uint32_t>(i));
    m.at[0][0] = body.mass.x;
    m.at[1][1] = body.mass.y;
    m.at[2][2] = body.mass.z;
    Matrix3d inertia;
    copy(body.inertia, inertia);
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) m.at[r + 3][c + 3] = inertia[r][c];
  }
  for (const IslandContact& contact : island.contacts)
    if (contact.count > 0) add_contact(island, contact, rho);
  for (const IslandJoint& joint : island.joints) add_joint(island, joint, rho);
}

Twist momentum_of(const IslandBody& body, const Twist& velocity) {
  return {multiply_each(body.mass, velocity.v), body.inertia * velocity.w};
}

namespace {

void add_to_body(const Island& island, int body, Twist momentum, double sign,
                 std::vector<Twist>& sum) {
  if (body == kFixed) return;
  const IslandBody& of = island.bodies[static_cast<std::size_t>(body)];
  if (of.restricted) momentum = {multiply_each(of.moves, momentum.v), of.turns * momentum.w};
  Twist& to = sum[static_cast<std::size_t>(body)];
  to.v += sign * momentum.v;
  to.w += sign * momentum.w;
}

}  // namespace

void add_wrench(const Island& island, const IslandContact& c, const Twist& wrench, double sign,
                std::vector<Twist>& momentum) {
  const Vec3d F = to_world(c, wrench.v), M = to_world(c, wrench.w);
  add_to_body(island, c.a, {F, cross(c.arm_a, F) + M}, -sign, momentum);
  add_to_body(island, c.b, {F, cross(c.arm_b, F) + M}, sign, momentum);
}

void add_impulses(const Island& island, const IslandJoint& joint, const double* impulse,
                  double sign, std::vector<Twist>& momentum) {
  for (int k = 0; k < joint.bodies; ++k) {
    Twist sum;
    for (int i = 0; i < joint.rows; ++i) sum = sum + impulse[i] * joint.J[i][k];
    add_to_body(island, joint.body[k], sum, sign, momentum);
  }
}

}  // namespace plumb::inline PLUMB_ABI::detail::newton
