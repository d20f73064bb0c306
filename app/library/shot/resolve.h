/// The one place where what a request leaves open is chosen.
#pragma once
#include "app/library/shot/scene_facts.h"
#include "app/library/shot/shot.h"

namespace splatray {

/// What a request comes to for a scene, which has its pools and looks as it was loaded (scene_source.h):
/// - view: choose_viewpoint of scans and of models of rooms; of other models the scene's own camera, else a view of all; of
///   drawings their own.
/// - colours: rgb where it says something, else intensity that varies, else none (plain); of sites, sweeps and rooms seen from
///   outside height, and intensity with it.
/// - look: scan where points have colours of their own, whose light is in them, and inside rooms, where little light comes; else lit.
/// - noise: taken out of whole pictures of 8 bits, unless --keep-noise, --despeckle, --error, --time or --reference decide.
/// - environment: beside a scene's own lights the studio, as strong for them as it is for lights of irradiance pi.
/// - exposure: of scans, of rooms seen from inside, of scenes in their own lights and in daylight left to the picture (Shot::exposes).
/// Throws Error (usage), one sentence, where the scene has not what is asked for or fields do not fit each other.
[[nodiscard]] Shot resolve(const Request& asked, const Scene& scene, const SceneFacts& facts);

/// What a request comes to before its scene is known: pixels, samples and files; a drawing is a still without its size. Throws Error as
/// plan_pictures does.
[[nodiscard]] Shot draft(const Request& asked);

/// The up direction of a scene as it was read: --up, else upright of upright.h.
[[nodiscard]] UpFound resolve_up(const Scene& scene, const Request& asked);

/// The attributes that a scene is shown in: those asked for, and the colours that suit it.
[[nodiscard]] AttributeOptions resolve_attributes(const Request& asked, const SceneFacts& facts);

/// The look, LOOK_*, of a request: that of --look, else LOOK_SCAN for scans in no light of their own or of the options' and without
/// materials of either, else LOOK_LIT.
[[nodiscard]] std::uint32_t resolve_look(const Scene& scene, const Request& request);

/// The tracer's settings for a request whose look is that of resolve_look, but for what a drawing and a region add.
[[nodiscard]] Settings resolve_settings(const Scene& scene, const Request& request);

/// Whether the noise of a picture in this look is taken out: as the request says, else of whole pictures for looking at of which
/// nothing decides that: what is measured or joined keeps it. A picture of the paper's look or of one sample goes through no denoiser.
[[nodiscard]] bool resolve_denoise(const Request& request, std::uint32_t look);

/// The tone curve: that of --tone, else Tone::soft, which leaves darks as they are, with --look paper and scan, Tone::neutral
/// otherwise.
[[nodiscard]] Tone resolve_tone(const Request& request);

/// The camera of a picture of this width / height: --eye, else the scene's own, else a view of the whole scene.
[[nodiscard]] Camera resolve_camera(const Scene& scene, const Request& request, double aspect);

}  // namespace splatray
