//! What the configuration of the X server says: one screen that is not there, and the devices that tests move.

use super::xorg::{PenDriver, SIZE};
use std::path::Path;

/// A device: its name, its driver, and what the driver is told.
struct Device {
    name: &'static str,
    driver: &'static str,
    options: Vec<(&'static str, String)>,
}

/// The devices, with their sockets in a folder.
fn devices(folder: &Path, pens: PenDriver) -> Vec<Device> {
    let at = |name: &str| folder.join(name).display().to_string();
    let tested = |name, kind: &str| {
        let options = vec![("SocketPath", at(name)), ("DeviceType", kind.to_owned())];
        Device { name, driver: "inputtest", options }
    };
    let mut devices =
        vec![tested("mouse", "Pointer"), tested("keyboard", "Keyboard"), tested("touch", "Touch")];
    // A mouse that goes as far as it is told.
    devices[0].options.push(("AccelerationScheme", "none".into()));
    devices[2].options.push(("TouchCount", "5".into()));
    match pens {
        PenDriver::InputTest => {
            let mut pen = tested("pen", "PointerAbsoluteProximity");
            pen.options.extend([("PointerHasPressure", "true".into()), ("PointerButtonCount", "9".into())]);
            devices.push(pen);
        }
        PenDriver::SimPen => {
            let simulated = |name, options| Device { name, driver: "simpen", options };
            devices.push(simulated("pen", vec![("Socket", at("pen"))]));
            let eraser = [("Socket", at("eraser")), ("Type", "ERASER".into()), ("Hub", at("hub"))];
            devices.push(simulated("eraser", eraser.into()));
        }
    }
    devices
}

impl Device {
    /// Its own section.
    fn section(&self) -> String {
        let Self { name, driver, options } = self;
        let options: String =
            options.iter().map(|(name, value)| format!("  Option \"{name}\" \"{value}\"\n")).collect();
        format!(
            "Section \"InputDevice\"\n  Identifier \"{name}\"\n  Driver \"{driver}\"\n{options}EndSection\n"
        )
    }

    /// Its line among those that are used.
    fn used(&self) -> String {
        let role = match self.name {
            "mouse" => "CorePointer",
            "keyboard" => "CoreKeyboard",
            _ => "SendCoreEvents",
        };
        format!("  InputDevice \"{}\" \"{role}\"\n", self.name)
    }
}

/// The whole file. Sockets and compiled drivers lie in `folder`, the server's own drivers in `modules`.
pub(crate) fn configuration(folder: &Path, modules: &str, pens: PenDriver) -> String {
    let devices = devices(folder, pens);
    let sections: String = devices.iter().map(Device::section).collect();
    let used: String = devices.iter().map(Device::used).collect();
    let own_modules = folder.join("modules").display().to_string();
    let (width, height) = SIZE;
    format!(
        r#"Section "Files"
  ModulePath "{own_modules}"
  ModulePath "{modules}"
EndSection
Section "ServerFlags"
  Option "AutoAddDevices" "false"
EndSection
Section "Device"
  Identifier "card"
  Driver "dummy"
  VideoRam 32768
EndSection
Section "Monitor"
  Identifier "monitor"
  HorizSync 5-1000
  VertRefresh 5-200
  Modeline "only" 83.5 {width} 1352 1480 1680 {height} 803 809 831
EndSection
Section "Screen"
  Identifier "screen"
  Device "card"
  Monitor "monitor"
  DefaultDepth 24
  SubSection "Display"
    Depth 24
    Modes "only"
  EndSubSection
EndSection
{sections}Section "ServerLayout"
  Identifier "all"
  Screen "screen"
{used}EndSection
"#
    )
}
