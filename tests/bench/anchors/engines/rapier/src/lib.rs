//! Rapier behind the C interface of ../rapier_c.h, with its default parameters.

use rapier3d::prelude::*;
use rapier3d::rayon::{ThreadPool, ThreadPoolBuilder};
use std::slice::from_raw_parts;
use std::sync::{Arc, OnceLock};

#[repr(C)]
pub struct Body {
    kind: i32,
    dynamic: i32,
    hull: u32,
    half: [f32; 3],
    radius: f32,
    half_length: f32,
    position: [f32; 3],
    turn: [f32; 4],
    velocity: [f32; 3],
    spin: [f32; 3],
    mass: f32,
    inertia: [f32; 3],
    force: [f32; 3],
}

#[repr(C)]
pub struct Joint {
    a: i32,
    b: i32,
    at_a: [f32; 3],
    at_b: [f32; 3],
}

#[repr(C)]
pub struct Scene {
    gravity: [f32; 3],
    friction: f32,
    friction_of_bodies: f32,
    restitution: f32,
    collide: i32,
    sleeping: i32,
    bodies: *const Body,
    body_count: usize,
    points: *const f32,
    hull_starts: *const u32,
    hull_count: usize,
    vertices: *const f32,
    vertex_count: usize,
    corners: *const u32,
    triangle_count: usize,
    joints: *const Joint,
    joint_count: usize,
}

pub struct World {
    physics: PhysicsWorld,
    bodies: Vec<RigidBodyHandle>,
}

// The order of anchors::ShapeKind.
const BOX: i32 = 1;
const SPHERE: i32 = 2;
const CAPSULE: i32 = 3;
const HULL: i32 = 4;
const MESH: i32 = 5;
const PLANE: i32 = 6;

fn vector(v: &[f32]) -> Vector {
    Vector::new(v[0], v[1], v[2])
}

/// The calling thread as a pool of its own, so that one thread hands nothing to another. A thread can
/// be that only once.
fn calling_thread() -> Arc<ThreadPool> {
    static POOL: OnceLock<Arc<ThreadPool>> = OnceLock::new();
    let make = || ThreadPoolBuilder::new().num_threads(1).use_current_thread().build();
    POOL.get_or_init(|| Arc::new(make().expect("a pool"))).clone()
}

/// A list that may be empty, and then null.
unsafe fn list<'a, T>(first: *const T, count: usize) -> &'a [T] {
    if count == 0 {
        &[]
    } else {
        unsafe { from_raw_parts(first, count) }
    }
}

/// # Safety
/// The scene and all that it points to must be valid during the call.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn plumb_rapier_new(scene: *const Scene, threads: usize) -> *mut World {
    let scene = unsafe { &*scene };
    let bodies = unsafe { list(scene.bodies, scene.body_count) };
    let starts = unsafe { list(scene.hull_starts, scene.hull_count + 1) };
    let end = starts.last().map_or(0, |&e| e as usize);
    let points: Vec<Vector> =
        unsafe { list(scene.points, 3 * end) }.chunks(3).map(vector).collect();
    let hulls: Vec<SharedShape> = starts
        .windows(2)
        .map(|w| SharedShape::convex_hull(&points[w[0] as usize..w[1] as usize]).expect("a hull"))
        .collect();

    let mut world = World { physics: PhysicsWorld::new(), bodies: Vec::new() };
    let physics = &mut world.physics;
    if threads == 1 {
        physics.set_thread_pool(Some(calling_thread()));
    } else {
        physics.configure_thread_pool(threads).expect("threads");
    }
    physics.gravity = vector(&scene.gravity);
    for body in bodies {
        let pose = Pose::from_parts(
            vector(&body.position),
            Rotation::from_xyzw(body.turn[0], body.turn[1], body.turn[2], body.turn[3]),
        );
        let mass = MassProperties::new(Vector::ZERO, body.mass, vector(&body.inertia));
        let builder = if body.dynamic != 0 {
            RigidBodyBuilder::dynamic()
        } else {
            RigidBodyBuilder::fixed()
        };
        let mut builder = builder
            .pose(pose)
            .linvel(vector(&body.velocity))
            .angvel(vector(&body.spin))
            .can_sleep(scene.sleeping != 0);
        let shape = match body.kind {
            BOX => Some(SharedShape::cuboid(body.half[0], body.half[1], body.half[2])),
            SPHERE => Some(SharedShape::ball(body.radius)),
            CAPSULE => Some(SharedShape::capsule_y(body.half_length, body.radius)),
            PLANE => Some(SharedShape::halfspace(Vector::new(0.0, 1.0, 0.0))),
            HULL => Some(hulls[body.hull as usize].clone()),
            MESH => {
                let vertices = unsafe { list(scene.vertices, 3 * scene.vertex_count) };
                let corners = unsafe { list(scene.corners, 3 * scene.triangle_count) };
                Some(
                    SharedShape::trimesh(
                        vertices.chunks(3).map(vector).collect(),
                        corners.chunks(3).map(|c| [c[0], c[1], c[2]]).collect(),
                    )
                    .expect("a mesh"),
                )
            }
            _ => None,
        };
        if shape.is_none() {
            builder = builder.additional_mass_properties(mass);
        }
        let handle = physics.bodies.insert(builder);
        let force = vector(&body.force);
        if force != Vector::ZERO {
            physics.bodies[handle].add_force(force, true); // stays
        }
        if let Some(shape) = shape {
            let mut collider = ColliderBuilder::new(shape)
                .friction(scene.friction_of_bodies)
                .restitution(scene.restitution);
            if body.dynamic != 0 {
                collider = collider.mass_properties(mass);
            } else if scene.friction < scene.friction_of_bodies {
                collider = collider
                    .friction(scene.friction)
                    .friction_combine_rule(CoefficientCombineRule::Min);
            }
            if scene.collide == 0 {
                collider = collider.collision_groups(InteractionGroups::none());
            }
            physics.colliders.insert_with_parent(collider, handle, &mut physics.bodies);
        }
        world.bodies.push(handle);
    }
    let joints = unsafe { list(scene.joints, scene.joint_count) };
    if !joints.is_empty() {
        let anchor = physics.bodies.insert(RigidBodyBuilder::fixed());
        for joint in joints {
            let held = SphericalJointBuilder::new()
                .local_anchor1(vector(&joint.at_a))
                .local_anchor2(vector(&joint.at_b));
            let a = if joint.a < 0 { anchor } else { world.bodies[joint.a as usize] };
            physics.insert_impulse_joint(a, world.bodies[joint.b as usize], held);
        }
    }
    Box::into_raw(Box::new(world))
}

/// # Safety
/// `world` must come from plumb_rapier_new.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn plumb_rapier_step(world: *mut World, dt: f32) {
    let world = unsafe { &mut *world };
    world.physics.integration_parameters.dt = dt;
    world.physics.step();
}

/// # Safety
/// `out` must have room for thirteen numbers a body.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn plumb_rapier_read(world: *const World, out: *mut f32) {
    let world = unsafe { &*world };
    let out = unsafe { std::slice::from_raw_parts_mut(out, 13 * world.bodies.len()) };
    for (handle, to) in world.bodies.iter().zip(out.chunks_mut(13)) {
        let body = &world.physics.bodies[*handle];
        let (q, p, v, w) = (body.rotation(), body.translation(), body.linvel(), body.angvel());
        to.copy_from_slice(&[
            p.x, p.y, p.z, q.x, q.y, q.z, q.w, v.x, v.y, v.z, w.x, w.y, w.z,
        ]);
    }
}

/// # Safety
/// `world` must come from plumb_rapier_new and is gone afterwards.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn plumb_rapier_free(world: *mut World) {
    drop(unsafe { Box::from_raw(world) });
}
