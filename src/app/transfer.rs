//! The clipboard, and files dropped on the window.
//!
//! What others offer arrives later, as an event: asking and receiving are separate. Pictures are taken as PNG or JPEG
//! bytes, files as `file://` addresses.
//!
//! Limits: dropped things that are no local files are ignored.

use std::io::Cursor;
use std::path::PathBuf;
use winit::data_transfer::{DataTransferId, DataTransferSend, DataTransferSendBuilder, TypeHint, TypedData};
use winit::event_loop::{ActiveEventLoop, DndAction};

/// Something that arrived.
#[derive(Debug, PartialEq)]
pub(super) enum Arrival {
    /// Text.
    Text(String),
    /// Local files.
    Files(Vec<PathBuf>),
    /// A PNG or JPEG file's bytes.
    Picture(Vec<u8>),
}

const PNG: TypeHint = TypeHint::Image { extension_hint: Some("png") };
const JPEG: TypeHint = TypeHint::Image { extension_hint: Some("jpg") };

/// Lets files be dropped.
pub(super) fn welcome(event_loop: &dyn ActiveEventLoop, id: DataTransferId) {
    let has_files = event_loop.data_transfer(id).is_ok_and(|offer| offer.has_type(&TypeHint::UriList));
    let actions: &[DndAction] = if has_files { &[DndAction::Copy] } else { &[] };
    if let Err(error) = event_loop.set_valid_dnd_actions(id, actions) {
        tracing::debug!("a drag cannot be answered: {error}");
    }
}

/// Asks for the addresses of dropped files.
pub(super) fn fetch_files(event_loop: &dyn ActiveEventLoop, id: DataTransferId) {
    fetch(event_loop, id, &[TypeHint::UriList]);
}

/// Asks for what the clipboard holds: a picture or files before text.
pub(super) fn fetch_clipboard(event_loop: &dyn ActiveEventLoop) {
    match event_loop.clipboard() {
        Ok(Some(id)) => fetch(event_loop, id, &[PNG, JPEG, TypeHint::UriList, TypeHint::Plaintext]),
        Ok(None) => {}
        Err(error) => tracing::warn!("the clipboard cannot be read: {error}"),
    }
}

/// Asks for the first of some types that there is.
fn fetch(event_loop: &dyn ActiveEventLoop, id: DataTransferId, types: &[TypeHint]) {
    let Ok(offer) = event_loop.data_transfer(id) else { return };
    if let Some(hint) = types.iter().find(|hint| offer.has_type(*hint))
        && let Err(error) = event_loop.fetch_data_transfer(id, hint)
    {
        tracing::warn!("what was offered cannot be fetched: {error}");
    }
}

/// What an arrived piece of data is; `None` for what the program cannot use.
pub(super) fn arrival(data: &dyn TypedData) -> Option<Arrival> {
    match data.type_().hint()? {
        TypeHint::UriList => {
            let files: Vec<PathBuf> =
                data.try_as_uris().ok()?.iter().filter_map(|uri| local_file(uri)).collect();
            (!files.is_empty()).then_some(Arrival::Files(files))
        }
        TypeHint::Image { .. } => data.try_as_bytes().ok().map(Arrival::Picture),
        TypeHint::Plaintext => data.try_as_string().ok().map(Arrival::Text),
        _ => None,
    }
}

/// The path in a `file://` address, with its `%41` escapes undone.
fn local_file(uri: &str) -> Option<PathBuf> {
    let path = uri.trim().strip_prefix("file://")?;
    // What stands before the path is the machine's name.
    let path = &path[path.find('/')?..];
    let mut bytes = Vec::with_capacity(path.len());
    let mut rest = path.bytes();
    while let Some(byte) = rest.next() {
        if byte == b'%' {
            let digits = [rest.next()?, rest.next()?];
            bytes.push(u8::from_str_radix(std::str::from_utf8(&digits).ok()?, 16).ok()?);
        } else {
            bytes.push(byte);
        }
    }
    String::from_utf8(bytes).ok().map(PathBuf::from)
}

/// Puts text on the clipboard.
pub(super) fn copy_text(event_loop: &dyn ActiveEventLoop, text: String) {
    let offer = DataTransferSendBuilder::new(text)
        .with_type(TypeHint::Plaintext, |text: &String, _| Some(text.clone()))
        .build();
    send(event_loop, offer);
}

/// Puts a picture on the clipboard, as PNG.
pub(super) fn copy_picture(event_loop: &dyn ActiveEventLoop, picture: &egui::ColorImage) {
    match png_bytes(picture) {
        Ok(png) => {
            let offer = DataTransferSendBuilder::new(png)
                .with_type(PNG, |png: &Vec<u8>, _| Some(png.clone()))
                .build();
            send(event_loop, offer);
        }
        Err(error) => tracing::warn!("the picture cannot be put on the clipboard: {error}"),
    }
}

fn send(event_loop: &dyn ActiveEventLoop, offer: Box<dyn DataTransferSend>) {
    if let Err(error) = event_loop.set_clipboard(offer) {
        tracing::warn!("the clipboard cannot be written: {error}");
    }
}

fn png_bytes(picture: &egui::ColorImage) -> Result<Vec<u8>, png::EncodingError> {
    let mut bytes = Cursor::new(Vec::new());
    let mut encoder = png::Encoder::new(&mut bytes, picture.width() as u32, picture.height() as u32);
    encoder.set_color(png::ColorType::Rgba);
    let mut writer = encoder.write_header()?;
    let pixels: Vec<u8> = picture.pixels.iter().flat_map(|c| c.to_srgba_unmultiplied()).collect();
    writer.write_image_data(&pixels)?;
    writer.finish()?;
    Ok(bytes.into_inner())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn addresses_of_local_files() {
        assert_eq!(local_file("file:///home/ann/a%20rose.png"), Some(PathBuf::from("/home/ann/a rose.png")));
        assert_eq!(
            local_file("file://desk/tmp/%E8%8A%B1.penstemon\r"),
            Some(PathBuf::from("/tmp/花.penstemon"))
        );
        for bad in ["https://example.org/a.png", "file://", "file:///a%2", "file:///a%zz", "file:///%ff", ""]
        {
            assert_eq!(local_file(bad), None, "{bad}");
        }
    }

    #[test]
    fn pictures_are_png() {
        let picture = egui::ColorImage::filled([3, 2], egui::Color32::from_rgb(10, 20, 30));
        let bytes = png_bytes(&picture).unwrap();
        let decoder = png::Decoder::new(Cursor::new(&bytes));
        let mut reader = decoder.read_info().unwrap();
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut pixels).unwrap();
        assert_eq!(&pixels[..4], [10, 20, 30, 255]);
        assert_eq!(pixels.len(), 24);
    }
}
