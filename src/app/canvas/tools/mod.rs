//! What pointers do on the canvas: a tool a file, each a [`Tool`](crate::app::tool::Tool) of the [`ToolContext`](super::tool_context::ToolContext).

mod erase;
mod handle;
mod lasso;
mod pen;
mod shown;
mod view;

pub(super) use erase::Erase;
pub(super) use handle::DragHandle;
pub(super) use lasso::Lasso;
pub(super) use pen::Pen;
pub(super) use shown::Shown;
pub(super) use view::{MoveView, ViewDrag};
