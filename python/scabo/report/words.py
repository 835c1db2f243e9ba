"""The outcome of a run and its certificate in plain words."""

# key of `certificate`: a question, what a small figure means, what it is measured by
CHECKS = (
    ("equilibrium", "Do all forces balance?",
     "The largest force left over at any node, after loads, reactions, contact forces and the stiffness of the bodies are added up.",
     "largest force"),
    ("rigid_balance", "Is every body as a whole in balance?",
     "The force or moment left over of any body, seen as one piece.", "largest force"),
    ("penetration", "Do bodies stay out of each other?", "The deepest overlap of any contact pair.", "largest motion"),
    ("tension", "Do contacts only push?", "The largest pull of any contact pair, beyond the tensile strength that the model gives it.",
     "largest force"),
    ("complementarity", "Do only closed pairs carry force?",
     "The largest product of gap and normal force: a pair is open or carries force, not both.", "largest force × largest motion"),
    ("friction_excess", "Does friction stay within its bound?", "The largest excess of a tangential force over the bound of friction.",
     "largest force"),
    ("slip_direction", "Does friction oppose slip?",
     "The largest slip along its own friction force, or slip of a pair whose friction is below its bound.", "largest motion"),
)

STATUS = {
    "solved": ("good", "Solved and certified"),
    "not_converged": ("bad", "Did not converge"),
    "mechanism": ("bad", "The loads are more than the structure can carry"),
    "collapse": ("bad", "The structure falls before the loads are reached"),
    "interrupted": ("warning", "Interrupted"),
    "failed": ("bad", "Ended by an error"),
    "running": ("warning", "Not finished: the run still writes, or was killed"),
}


def verdict(summary, increments):
    """How the run ended: a level for its colour, a heading and sentences."""
    level, heading = STATUS.get(summary["status"], ("bad", summary["status"].replace("_", " ")))
    sentences = [sentence(summary["reason"])] if summary.get("reason") else []
    if summary.get("limit"):
        sentences.append(limit_found(summary["limit"]))
    if summary.get("mechanism"):
        sentences.append(f"{sentence(summary['mechanism']['text'])} The file mechanism.vtu shows the motion.")
    if summary.get("analysis") == "modal":
        count = len(summary.get("modes", []))
        heading = "Solved" if summary["status"] == "solved" else heading
        return {"level": level, "heading": heading, "text": f"{count} natural mode{'s' * (count != 1)} of vibration."}
    count = len(increments)
    if count and summary["status"] == "solved":
        sentences.append(f"{'All ' + str(count) + ' increments' if count > 1 else 'The increment'} converged, and the solution of "
                         f"{'each' if count > 1 else 'it'} was checked afterwards, independently of how it was found.")
    elif count:
        sentences.append(f"The results of the {count} finished increment{'s' * (count != 1)} are certified.")
    else:
        sentences.append("No increment was finished, so that there are no results.")
    if count and summary.get("model", {}).get("forces_of"):
        sentences.append(f"Forces are those of {summary['model']['forces_of']}.")
    return {"level": level, "heading": heading, "text": " ".join(sentences)}


def limit_found(limit):
    if limit["beyond"] is None:
        return f"No limit was found: there is equilibrium up to the factor {limit['solved']:.6g}."
    beyond = {"not_decided": "whether there is equilibrium beyond it was not decided"}.get(limit["by"], f"{limit['by']} beyond it")
    return f"The limit is between the factors {limit['solved']:.6g} and {limit['beyond']:.6g}: {beyond}."


def sentence(text):
    return text[:1].upper() + text[1:] + ("" if text.endswith((".", "!", "?")) else ".")


def certificate(increments):
    """For every check the worst figure of all increments and the number, from 1, of the increment that has it."""
    rows = []
    for key, question, meaning, measure in CHECKS:
        figures = [(abs(entry["certificate"][key]), number) for number, entry in enumerate(increments, start=1)
                   if (entry.get("certificate") or {}).get(key) is not None]
        if figures:
            worst, number = max(figures, key=lambda figure: (figure[0], -figure[1]))
            rows.append({"key": key, "question": question, "meaning": meaning, "measure": measure, "worst": worst, "increment": number})
    return rows
