//! The files that make the program part of a desktop agree with each other.

#[test]
fn the_desktop_files_agree_with_each_other() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/desktop");
    let read = |name: &str| std::fs::read_to_string(folder.join(name)).unwrap();
    let (id, mime) = ("org.penstemon.Penstemon", "application/x-penstemon");
    let entry = read("org.penstemon.Penstemon.desktop");
    assert!(entry.contains(&format!("StartupWMClass={id}\n")) && entry.contains(&format!("Icon={id}\n")));
    assert!(entry.lines().any(|line| line.starts_with("MimeType=") && line.contains(mime)));
    let types = read("org.penstemon.Penstemon.mime.xml");
    let types = roxmltree::Document::parse(&types).unwrap();
    assert!(types.descendants().any(|node| node.attribute("type") == Some(mime)));
    assert!(types.descendants().any(|node| node.attribute("pattern") == Some("*.penstemon")));
    let about = read("org.penstemon.Penstemon.metainfo.xml");
    let about = roxmltree::Document::parse(&about).unwrap();
    let text =
        |name: &str| about.descendants().find(|node| node.has_tag_name(name)).and_then(|node| node.text());
    assert_eq!((text("id"), text("mediatype")), (Some(id), Some(mime)));
    let icon = read("penstemon.svg");
    let icon = roxmltree::Document::parse(&icon).unwrap();
    assert_eq!(icon.root_element().attribute("viewBox"), Some("0 0 256 256"));
}
