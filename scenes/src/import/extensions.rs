//! Extensions of glTF: read, refused or told of, never dropped.

use super::ImportError;

/// Extensions whose absence from the image would be noticed, and what to do.
const REFUSED: [(&str, &str); 13] = [
    ("KHR_draco_mesh_compression", "export without mesh compression"),
    ("EXT_meshopt_compression", "export without mesh compression"),
    ("KHR_meshopt_compression", "export without mesh compression"),
    ("EXT_mesh_gpu_instancing", "export instances as nodes"),
    ("KHR_materials_clearcoat", "take the coat out of the material"),
    ("KHR_materials_sheen", "take the sheen out of the material"),
    ("KHR_materials_iridescence", "take the iridescence out of the material"),
    ("KHR_materials_anisotropy", "take the anisotropy out of the material"),
    ("KHR_materials_specular", "glass reflects what its index says: take the extension out"),
    ("KHR_materials_diffuse_transmission", "only clear glass is rendered"),
    ("KHR_materials_pbrSpecularGlossiness", "write pbrMetallicRoughness"),
    ("KHR_materials_subsurface", "only clear glass is rendered"),
    ("KHR_materials_volume_scatter", "only clear glass is rendered"),
];
/// Extensions that are read.
const KNOWN: [&str; 8] = [
    "KHR_materials_ior",
    "KHR_materials_transmission",
    "KHR_materials_volume",
    "KHR_materials_dispersion",
    "KHR_materials_emissive_strength",
    "KHR_materials_unlit",
    "KHR_lights_punctual",
    "KHR_mesh_quantization",
];

/// Stops at extensions that change what is seen, or that the file cannot be read
/// without; answers with a warning for each of the others that is not read.
pub(super) fn check(document: &gltf::Document, file: &str) -> Result<Vec<String>, ImportError> {
    let wrong = |name: &str, what: String| ImportError::Value {
        file: file.to_owned(),
        place: name.to_owned(),
        what,
    };
    let used = document.extensions_used().chain(document.extensions_required());
    for used in used {
        if let Some((name, instead)) = REFUSED.iter().find(|(name, _)| *name == used) {
            return Err(wrong(name, format!("it is not read; {instead}")));
        }
    }
    if let Some(name) = document.extensions_required().find(|name| !KNOWN.contains(name)) {
        let what = "the file cannot be read without it, and it is not known; export without it";
        return Err(wrong(name, what.to_owned()));
    }
    let unread = document.extensions_used().filter(|name| !KNOWN.contains(name));
    Ok(unread.map(|name| format!("{name} is not read")).collect())
}

/// Holds the document to the format; extensions have been judged by [`check`].
pub(super) fn validate(document: &gltf::Document) -> Result<(), gltf::Error> {
    use gltf::json::validation::{Error, Validate};
    let mut errors = Vec::new();
    let root = document.as_json();
    root.validate(root, gltf::json::Path::new, &mut |path, error| {
        if !matches!(error, Error::Unsupported) {
            errors.push((path(), error));
        }
    });
    if errors.is_empty() { Ok(()) } else { Err(gltf::Error::Validation(errors)) }
}
