//! The components that a column may name: those of Rerun's archetypes that Plumb draws with, taken
//! from the generated descriptors so that the compiler checks them, and Plumb's own.

use std::collections::HashMap;
use std::sync::LazyLock;

use re_sdk_types::archetypes::{
    Arrows3D, Boxes3D, Capsules3D, Cylinders3D, Ellipsoids3D, InstancePoses3D, LineStrips3D,
    Mesh3D, Points3D, Scalars, SeriesLines, TextDocument, TextLog, ViewCoordinates,
};
use re_sdk_types::{ArchetypeName, ComponentDescriptor, ComponentIdentifier};

use crate::columns::ValueType;
use crate::failure::Failure;

/// What every archetype of Plumb's own begins with.
const OWN_PREFIX: &str = "plumb.";

struct Known {
    descriptor: ComponentDescriptor,
    value_type: ValueType,
    width: u32,
}

static KNOWN: LazyLock<HashMap<String, Known>> = LazyLock::new(|| {
    use ValueType::{F32, F64, Text, U8, U32};
    let table = [
        (Boxes3D::descriptor_half_sizes(), F32, 3),
        (Boxes3D::descriptor_centers(), F32, 3),
        (Boxes3D::descriptor_quaternions(), F32, 4),
        (Boxes3D::descriptor_colors(), U32, 1),
        (Boxes3D::descriptor_fill_mode(), U8, 1),
        (Boxes3D::descriptor_labels(), Text, 1),
        (Ellipsoids3D::descriptor_half_sizes(), F32, 3),
        (Ellipsoids3D::descriptor_centers(), F32, 3),
        (Ellipsoids3D::descriptor_quaternions(), F32, 4),
        (Ellipsoids3D::descriptor_colors(), U32, 1),
        (Ellipsoids3D::descriptor_fill_mode(), U8, 1),
        (Capsules3D::descriptor_lengths(), F32, 1),
        (Capsules3D::descriptor_radii(), F32, 1),
        (Capsules3D::descriptor_translations(), F32, 3),
        (Capsules3D::descriptor_quaternions(), F32, 4),
        (Capsules3D::descriptor_colors(), U32, 1),
        (Capsules3D::descriptor_fill_mode(), U8, 1),
        (Cylinders3D::descriptor_lengths(), F32, 1),
        (Cylinders3D::descriptor_radii(), F32, 1),
        (Cylinders3D::descriptor_centers(), F32, 3),
        (Cylinders3D::descriptor_quaternions(), F32, 4),
        (Cylinders3D::descriptor_colors(), U32, 1),
        (Cylinders3D::descriptor_fill_mode(), U8, 1),
        (Mesh3D::descriptor_vertex_positions(), F32, 3),
        (Mesh3D::descriptor_vertex_normals(), F32, 3),
        (Mesh3D::descriptor_triangle_indices(), U32, 3),
        (Mesh3D::descriptor_albedo_factor(), U32, 1),
        (InstancePoses3D::descriptor_translations(), F32, 3),
        (InstancePoses3D::descriptor_quaternions(), F32, 4),
        (InstancePoses3D::descriptor_scales(), F32, 3),
        (Points3D::descriptor_positions(), F32, 3),
        (Points3D::descriptor_radii(), F32, 1),
        (Points3D::descriptor_colors(), U32, 1),
        (Points3D::descriptor_labels(), Text, 1),
        (Arrows3D::descriptor_origins(), F32, 3),
        (Arrows3D::descriptor_vectors(), F32, 3),
        (Arrows3D::descriptor_radii(), F32, 1),
        (Arrows3D::descriptor_colors(), U32, 1),
        (LineStrips3D::descriptor_colors(), U32, 1),
        (Scalars::descriptor_scalars(), F64, 1),
        (SeriesLines::descriptor_names(), Text, 1),
        (SeriesLines::descriptor_colors(), U32, 1),
        (SeriesLines::descriptor_widths(), F32, 1),
        (TextLog::descriptor_text(), Text, 1),
        (TextLog::descriptor_level(), Text, 1),
        (TextDocument::descriptor_text(), Text, 1),
        (TextDocument::descriptor_media_type(), Text, 1),
        (ViewCoordinates::descriptor_xyz(), U8, 3),
    ];
    table
        .into_iter()
        .map(|(descriptor, value_type, width)| {
            (
                descriptor.component.to_string(),
                Known {
                    descriptor,
                    value_type,
                    width,
                },
            )
        })
        .collect()
});

/// The descriptor of a component, checked against the type that Rerun expects.
pub fn descriptor(
    name: &str,
    value_type: ValueType,
    width: u32,
) -> Result<ComponentDescriptor, Failure> {
    if let Some(known) = KNOWN.get(name) {
        if known.value_type != value_type || known.width != width {
            return Err(Failure::argument(format!(
                "component {name} takes {:?} x {}, but was given {value_type:?} x {width}",
                known.value_type, known.width
            )));
        }
        return Ok(known.descriptor.clone());
    }
    match name.split_once(':') {
        Some((archetype, field))
            if archetype.len() > OWN_PREFIX.len()
                && archetype.starts_with(OWN_PREFIX)
                && !field.is_empty() =>
        {
            let invalid = |e: &dyn std::fmt::Display| Failure::argument(format!("{name}: {e}"));
            let component = ComponentIdentifier::try_new(name).map_err(|e| invalid(&e))?;
            let archetype = ArchetypeName::try_new(archetype).map_err(|e| invalid(&e))?;
            Ok(ComponentDescriptor::partial(component).with_archetype(archetype))
        }
        _ => Err(Failure::argument(format!(
            "unknown component '{name}': give one of Rerun's, or plumb.<Archetype>:<field>"
        ))),
    }
}
