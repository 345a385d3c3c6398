# dataset.smk: the workflow of tools/dataset. What its two steps do is in dataset_steps.py.
import sys

sys.path.insert(0, workflow.basedir)
import dataset_steps

steps = f"python3 {workflow.basedir}/dataset_steps.py"
models = {model.name: model.path for model in dataset_steps.find_models(config["dir"])}


rule tables:
    input:
        expand("models/{name}/row.json", name=models),
    output:
        "index.html", "table.txt", "table.csv", "models.csv",
    shell:
        "{steps} tables {config[dir]:q}"


# A new program makes all rows anew; a part that fails has a row too.
rule model:
    input:
        part=lambda wildcards: models[wildcards.name],
        program=config["polylab"],
    output:
        "models/{name}/row.json",
    wildcard_constraints:
        name=".+",
    shell:
        "{steps} model {input.part:q} models/{wildcards.name:q} {input.program:q} {config[size]:q}"
