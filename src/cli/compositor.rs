//! Pictures without a desktop: keeps Mesa's Vulkan layer from looking for one.
//!
//! `VK_LAYER_MESA_device_select` asks the Wayland compositor which graphics device is the main one, whoever uses Vulkan and
//! for whatever; without `XDG_RUNTIME_DIR` libwayland then complains on the standard error stream. A picture needs no
//! compositor. The Vulkan loader leaves the layer out where an environment variable says so; as Rust has no safe way to set
//! one for its own process, the program replaces itself by itself with the variable set, before anything is read. That takes
//! some milliseconds, and is done only where there would be complaints.

use std::env;
use std::os::unix::process::CommandExt as _;

/// What the Vulkan loader reads, by the layer's description.
const SWITCH: &str = "NODEVICE_SELECT";

/// Sees to it that nobody looks for a compositor that cannot be there. Returns where all is well, or cannot be changed.
pub(super) fn leave_alone() {
    let folder = env::var_os("XDG_RUNTIME_DIR");
    let may_be_there = folder.is_some_and(|folder| std::path::Path::new(&folder).is_absolute());
    let mut words = env::args_os();
    if may_be_there || env::var_os(SWITCH).is_some() {
        return;
    }
    if let (Ok(program), Some(name)) = (env::current_exe(), words.next()) {
        // Only a failure comes back: then the layer complains, and the picture is made all the same.
        let _ = std::process::Command::new(program).arg0(name).args(words).env(SWITCH, "1").exec();
    }
}
