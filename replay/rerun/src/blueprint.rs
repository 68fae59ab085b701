//! The layout that the Rerun viewer shows when a recording is opened, embedded in the file.

use std::ffi::c_char;

use re_chunk::{Chunk, RowId};
use re_log_types::{
    ApplicationId, BlueprintActivationCommand, LogMsg, StoreId, TimeInt, TimePoint, Timeline,
};
use re_sdk::blueprint::{
    Blueprint, BlueprintActivation, BlueprintPanel, ContainerLike, Horizontal, SelectionPanel,
    Spatial3DView, Tabs, TextDocumentView, TextLogView, TimePanel, TimeSeriesView, Vertical,
};
use re_sdk_types::AsComponents;
use re_sdk_types::blueprint::archetypes::{EyeControls3D, LineGrid3D};
use re_sdk_types::blueprint::components::{Eye3DKind, PanelState};
use re_sdk_types::components::Plane3D;

use crate::failure::{Failure, text_from};

/// Share of the window's width that the 3D views take, beside 2 for the column of the others.
const WIDTH_OF_3D: f32 = 3.0;
const WIDTH_OF_OTHERS: f32 = 2.0;
/// 0xRRGGBBAA
const GRID_COLOR: u32 = 0xd8e6f070;

#[repr(C)]
pub struct CView {
    kind: u32,
    name: *const c_char,
    contents: *const c_char,
    tab: u32,
}

#[repr(C)]
pub struct CLayout {
    views: *const CView,
    view_count: usize,
    timeline: *const c_char,
    frames_per_second: f32,
    eye: [f32; 3],
    target: [f32; 3],
    up: [f32; 3],
    followed: *const c_char,
    grid_height: f32,
    grid_spacing: f32,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum ViewKind {
    Space,
    Plot,
    TextLog,
    Document,
}

struct View {
    kind: ViewKind,
    name: String,
    contents: Vec<String>,
    tab: u32,
}

pub struct Layout {
    views: Vec<View>,
    timeline: String,
    frames_per_second: f32,
    eye: [f32; 3],
    target: [f32; 3],
    up: [f32; 3],
    followed: Option<String>,
    grid_height: f32,
    grid_spacing: f32,
}

impl Layout {
    /// # Safety
    /// All pointers as `plumb_rerun.h` says.
    pub unsafe fn from_c(layout: &CLayout) -> Result<Self, Failure> {
        if layout.views.is_null() || layout.view_count == 0 {
            return Err(Failure::argument("a layout needs views"));
        }
        let mut views = Vec::with_capacity(layout.view_count);
        for view in unsafe { std::slice::from_raw_parts(layout.views, layout.view_count) } {
            views.push(View {
                kind: match view.kind {
                    0 => ViewKind::Space,
                    1 => ViewKind::Plot,
                    2 => ViewKind::TextLog,
                    3 => ViewKind::Document,
                    other => return Err(Failure::argument(format!("{other} is no kind of view"))),
                },
                name: unsafe { text_from(view.name, "view name")? }.to_owned(),
                contents: unsafe { text_from(view.contents, "view contents")? }
                    .lines()
                    .map(str::to_owned)
                    .collect(),
                tab: view.tab,
            });
        }
        Ok(Self {
            views,
            timeline: unsafe { text_from(layout.timeline, "timeline")? }.to_owned(),
            frames_per_second: layout.frames_per_second,
            eye: layout.eye,
            target: layout.target,
            up: layout.up,
            followed: if layout.followed.is_null() {
                None
            } else {
                Some(unsafe { text_from(layout.followed, "followed entity")? }.to_owned())
            },
            grid_height: layout.grid_height,
            grid_spacing: layout.grid_spacing,
        })
    }

    /// The messages of a blueprint store, followed by the command that activates it.
    pub fn messages(&self, application_id: ApplicationId) -> Result<Vec<LogMsg>, Failure> {
        let (blueprint, space_path) = self.blueprint();
        let failed = |error: &dyn std::fmt::Display| Failure::argument(format!("layout: {error}"));
        let (stream, storage) = re_sdk::RecordingStreamBuilder::new(application_id)
            .send_properties(false)
            .memory()
            .map_err(|e| failed(&e))?;
        blueprint
            .send(&stream, BlueprintActivation::default())
            .map_err(|e| failed(&e))?;
        stream.flush_blocking().map_err(|e| failed(&e))?;

        let sent: Vec<LogMsg> = storage
            .take()
            .into_iter()
            .filter(|m| m.store_id().is_blueprint())
            .collect();
        let is_command = |m: &LogMsg| matches!(m, LogMsg::BlueprintActivationCommand(_));
        let (commands, mut messages): (Vec<_>, Vec<_>) = sent.into_iter().partition(is_command);
        let store = match commands.first() {
            Some(LogMsg::BlueprintActivationCommand(BlueprintActivationCommand {
                blueprint_id,
                ..
            })) => blueprint_id.clone(),
            _ => return Err(failed(&"the SDK made no blueprint")),
        };
        if let Some(path) = space_path {
            messages.extend(
                self.space_properties(&store, &path)
                    .map_err(|e| failed(&e))?,
            );
        }
        messages.extend(commands);
        Ok(messages)
    }

    /// And the blueprint path of the first 3D view.
    fn blueprint(&self) -> (Blueprint, Option<String>) {
        let mut space_path = None;
        let mut spaces = Vec::new();
        let mut others: Vec<(u32, Vec<ContainerLike>)> = Vec::new();
        for view in &self.views {
            let (name, contents) = (view.name.as_str(), view.contents.clone());
            let made: ContainerLike = match view.kind {
                ViewKind::Space => Spatial3DView::new(name).with_contents(contents).into(),
                ViewKind::Plot => TimeSeriesView::new(name).with_contents(contents).into(),
                ViewKind::TextLog => TextLogView::new(name).with_contents(contents).into(),
                ViewKind::Document => TextDocumentView::new(name).with_contents(contents).into(),
            };
            if view.kind == ViewKind::Space {
                if let ContainerLike::View(inner) = &made {
                    space_path.get_or_insert_with(|| inner.blueprint_path().to_string());
                }
                spaces.push(made);
            } else if let Some((_, place)) = others.iter_mut().find(|(tab, _)| *tab == view.tab) {
                place.push(made);
            } else {
                others.push((view.tab, vec![made]));
            }
        }
        let column = others.into_iter().map(|(_, mut place)| {
            if place.len() == 1 {
                place.remove(0)
            } else {
                Tabs::new(place).into()
            }
        });
        let root = Horizontal::new([Vertical::new(spaces).into(), Vertical::new(column).into()])
            .with_column_shares([WIDTH_OF_3D, WIDTH_OF_OTHERS]);
        let blueprint = Blueprint::new(root)
            .with_auto_views(false)
            .with_auto_layout(false)
            .with_blueprint_panel(BlueprintPanel::from_state(PanelState::Collapsed))
            .with_selection_panel(SelectionPanel::from_state(PanelState::Collapsed))
            .with_time_panel(
                TimePanel::new()
                    .with_state(PanelState::Collapsed)
                    .with_timeline(self.timeline.clone())
                    .with_fps(f64::from(self.frames_per_second)),
            );
        (blueprint, space_path)
    }

    /// Camera and grid of the 3D view; the SDK's builders do not offer them.
    fn space_properties(
        &self,
        store: &StoreId,
        view_path: &str,
    ) -> re_chunk::ChunkResult<Vec<LogMsg>> {
        let mut messages = Vec::new();
        let mut add = |name: &str, archetype: &dyn AsComponents| -> re_chunk::ChunkResult<()> {
            let time = TimePoint::default().with(
                Timeline::new_sequence("blueprint"),
                TimeInt::new_temporal(0),
            );
            let path = format!("{view_path}/{name}");
            let chunk = Chunk::builder(path.as_str())
                .with_archetype(RowId::new(), time, archetype)
                .build()?;
            messages.push(LogMsg::ArrowMsg(store.clone(), chunk.to_arrow_msg()?));
            Ok(())
        };
        let grid = LineGrid3D::new();
        let grid = if self.grid_spacing > 0.0 {
            grid.with_visible(true)
                .with_spacing(self.grid_spacing)
                .with_plane(Plane3D::new(self.up, self.grid_height))
                .with_color(GRID_COLOR)
        } else {
            grid.with_visible(false)
        };
        add("LineGrid3D", &grid)?;
        if self.eye != self.target {
            let mut eye = EyeControls3D::new()
                .with_kind(Eye3DKind::Orbital)
                .with_position(self.eye)
                .with_look_target(self.target)
                .with_eye_up(self.up);
            if let Some(entity) = &self.followed {
                eye = eye.with_tracking_entity(entity.as_str());
            }
            add("EyeControls3D", &eye)?;
        }
        Ok(messages)
    }
}
