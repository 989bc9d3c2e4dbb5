//! Penstemon turns pen strokes into 3D plants.
//!
//! Data flows down this list; a module uses only modules above it:
//!
//! | module | purpose |
//! | --- | --- |
//! | [`quote`] | words of users and files in messages |
//! | [`suggest`] | the known word nearest to a mistyped one |
//! | [`checksum`] | short checksums of names |
//! | [`budget`] | what one plant may cost |
//! | [`params`] | numbers declared with default, range, unit and help |
//! | [`random`] | random streams named by what they decide |
//! | [`srgb`] | encoded colours to light and back |
//! | [`kept`] | what stages made, kept from one build to the next |
//! | [`geom`] | polylines, frames, polygons, ellipses: mathematics that knows no plant |
//! | [`file_system`] | the file system as files are written to it: the machine's, or one that fails on purpose |
//! | [`atomic`] | files written whole or not at all |
//! | [`input`] | files read within limits, and never written over |
//! | [`obj_text`] | the geometry of OBJ files, screened and parsed |
//! | [`picture`] | pictures of the artist's own, in memory |
//! | [`lobes`] | bodies that crowns fill, from strokes in space |
//! | [`sketch`] | the document: strokes, tools, file formats |
//! | [`pen`] | what every pointing device says, in one form |
//! | [`plant`] | the waist: branches and organs in space, and what they are |
//! | [`learned_depth`] | how deep a drawn crown is, by a network that has seen thousands of trees |
//! | [`flower`] | full flowers: petals in layers |
//! | [`leaf`] | leaves from numbers, compound leaves |
//! | [`rose`] | roses from measured form |
//! | [`grammar`] | L-systems as text, and what they draw |
//! | [`anatomy`] | what the strokes mean, still flat |
//! | [`depth`] | anatomy to plant |
//! | [`modelling`] | branches drawn in space, wood turned and bent |
//! | [`growth`] | plants that grow themselves |
//! | [`species`] | what the drawing does not say: materials, forms, centres of flowers |
//! | [`model`] | plant to meshes |
//! | [`cards`] | foliage as pictures |
//! | [`photo`] | photographs of petals, leaves and bark to outlines and textures, of whole plants to crowns to grow into |
//! | [`garden`] | places of plants by the thousand, and copies of a few plants there |
//! | [`pipeline`] | all of these in a row |
//! | [`formats`] | model files, written and read: OBJ, glTF, JSON |
//! | [`render`] | pictures |
//! | [`app`] | the window |
//! | [`cli`] | the command line |

pub mod anatomy;
#[cfg(feature = "program")]
pub mod app;
pub mod atomic;
pub mod budget;
pub mod cards;
pub mod checksum;
#[cfg(feature = "program")]
pub mod cli;
pub mod depth;
pub mod file_system;
pub mod flower;
pub mod formats;
pub mod garden;
pub mod geom;
pub mod grammar;
pub mod growth;
pub mod input;
pub mod kept;
pub mod leaf;
pub mod learned_depth;
pub mod lobes;
pub mod model;
pub mod modelling;
pub mod obj_text;
pub mod params;
pub mod pen;
pub mod photo;
pub mod picture;
pub mod pipeline;
pub mod plant;
pub mod quote;
pub mod random;
#[cfg(feature = "program")]
pub mod render;
pub mod rose;
pub mod sketch;
pub mod species;
pub mod srgb;
pub mod suggest;
