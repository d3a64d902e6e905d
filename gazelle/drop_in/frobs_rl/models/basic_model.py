"""Common base of the algorithms: parameters, checkpoints, logs."""

from __future__ import annotations

import time
from collections.abc import Mapping
from pathlib import Path
from typing import Any, ClassVar

from gymnasium.spaces import Box

from gazelle.drop_in.frobs_rl.common.connection import parameter
from gazelle.drop_in.frobs_rl.common.ros_params import ros_load_yaml_from_pkg
from gazelle.drop_in.frobs_rl.models.library import stable_baselines3
from gazelle.drop_in.frobs_rl.models.utils import check_env, get_action_noise, get_policy_kwargs
from gazelle.drop_in.frobs_rl.wrappers.modern import modern
from gazelle.errors import TaskError
from gazelle_ros.base.writing import replacing
from gazelle_ros.compat import rospy


class BasicModel:
    """A model of Stable-Baselines3 with parameters below ``NS/model_params``.

    Args:
        env: Environment for learning.
        save_model_path: The folder of its checkpoints and models; with ``load_trained`` the model's file.
        log_path: The folder of its logs.
        load_trained: Load a model that is used as it is.
        load_il_policy: Begin with a policy that was learned by imitation (A2C and PPO).
        il_policy_path: Its file.
        config_file_pkg: The package with the parameters in its folder ``config``.
        config_filename: Their file; the algorithm's own if None.
        ns: Namespace of the parameters.

    Attributes:
        model: Stable-Baselines3's.

    Raises:
        TaskError: The parameters are not found, a model to continue with is missing, or logs of a run of
            that name are there already.
        MissingExtraError: Stable-Baselines3 is not installed.
    """

    algorithm: ClassVar[str] = ""
    has_noise: ClassVar[bool] = False
    has_sde: ClassVar[bool] = False

    def __init__(
        self,
        env: Any,
        save_model_path: str,
        log_path: str,
        load_trained: bool = False,  # noqa: FBT001, FBT002  # frobs_rl's interface
        load_il_policy: bool = False,  # noqa: FBT001, FBT002
        il_policy_path: str | None = None,
        config_file_pkg: str = "frobs_rl",
        config_filename: str | None = None,
        ns: str = "/",
    ) -> None:
        self.env = None if env is None else modern(env)
        self.ns = ns
        self.save_model_path, self.log_path = str(save_model_path), str(log_path)
        self.save_trained_model_path: str | None = None
        self._kind = getattr(stable_baselines3(), self.algorithm)
        file = config_filename or f"{self.algorithm.lower()}_config.yaml"
        if load_trained:
            self.model: Any = self._kind.load(self.save_model_path, env=self.env)
            return
        if not ros_load_yaml_from_pkg(config_file_pkg, file, ns=ns):
            raise TaskError(
                f"the package '{config_file_pkg}' has no parameters in config/{file}",
                hint="the log says why",
            )
        self.policy_kwargs = get_policy_kwargs(ns)
        self.checkpoint_callback = stable_baselines3("common.callbacks").CheckpointCallback(
            save_freq=int(self.parameter("save_freq")),
            save_path=self.save_model_path,
            name_prefix=str(self.parameter("save_prefix")),
        )
        if load_il_policy:
            self.model = self._kind.load(il_policy_path, env=self.env, **self._options())
        elif self.parameter("load_model"):
            self.model = self._continued(str(self.parameter("model_name")))
        else:
            policy: dict[str, Any] = {"policy_kwargs": self.policy_kwargs, "verbose": 1}
            self.model = self._kind("MlpPolicy", self.env, **policy, **self._options())
        self.set_model_logger()

    def parameter(self, name: str) -> Any:
        """Return a parameter below ``model_params``.

        Raises:
            KeyError: It is not set.
        """
        return rospy.get_param(parameter(self.ns, f"model_params/{name}"))

    def _options(self) -> dict[str, Any]:
        """Return the arguments of the algorithm."""
        own: Mapping[str, Any] = self.parameter(f"{self.algorithm.lower()}_params")
        options = dict(own)
        frequency = options.get("train_freq")
        if isinstance(frequency, Mapping):
            options["train_freq"] = (int(frequency["freq"]), str(frequency["unit"]))
        with_sde = self.has_sde and bool(self._optional("use_sde"))
        if self.has_sde:
            options["use_sde"] = with_sde
        if with_sde:
            options.update(self.parameter("sde_params"))
        space = None if self.env is None else self.env.action_space
        if self.has_noise and not with_sde and isinstance(space, Box):
            options["action_noise"] = get_action_noise(space.shape, self.ns)
        return options

    def _optional(self, name: str) -> Any:
        return rospy.get_param(parameter(self.ns, f"model_params/{name}"), None)

    def _continued(self, name: str) -> Any:
        """Return a model saved earlier, with its replay buffer if that was saved."""
        file = Path(self.save_model_path) / name
        if not file.with_name(f"{name}.zip").is_file():
            raise TaskError(f"there is no model '{name}' to go on with", file=f"{file}.zip")
        model = self._kind.load(file, env=self.env, verbose=1, **self._options())
        buffer = file.with_name(f"{name}_replay_buffer.pkl")
        if buffer.is_file() and hasattr(model, "load_replay_buffer"):
            model.load_replay_buffer(buffer)
        return model

    def train(self) -> bool:
        """Train for ``training_steps``, and save the model; returns True."""
        self.model.learn(
            total_timesteps=int(self.parameter("training_steps")),
            callback=self.checkpoint_callback,
            log_interval=int(self.parameter("log_interval")),
            reset_num_timesteps=bool(self.parameter("reset_num_timesteps")),
        )
        return self.save_model()

    def save_model(self) -> bool:
        """Save the model as ``trained_model_name``, with the time behind it if that is there; returns True."""
        name = str(self.parameter("trained_model_name"))
        path = Path(self.save_model_path) / name
        if path.with_name(f"{name}.zip").is_file():
            path = path.with_name(f"{name}_{time.strftime('%d_%m_%Y_%H_%M_%S')}")
            rospy.logwarn(f"there is a model '{name}' already; this one is saved as '{path.name}'")
        path.parent.mkdir(parents=True, exist_ok=True)
        self.save_trained_model_path = str(path)
        file = path if path.suffix else path.with_suffix(".zip")
        with replacing(file) as draft:
            self.model.save(draft)
        self.save_replay_buffer()
        return True

    def save_replay_buffer(self) -> bool:
        """Save the replay buffer beside the saved model, if ``save_replay_buffer`` is set; returns True.

        Raises:
            ValueError: No model has been saved.
        """
        if self.save_trained_model_path is None:
            raise ValueError("train or save the model before its replay buffer")
        if self.parameter("save_replay_buffer") and hasattr(self.model, "save_replay_buffer"):
            file = Path(f"{self.save_trained_model_path}_replay_buffer")
            with replacing(file if file.suffix else file.with_suffix(".pkl")) as draft:
                self.model.save_replay_buffer(draft)
        return True

    def set_model_logger(self) -> bool:
        """Log into ``log_folder``: to the screen, as CSV and for TensorBoard; returns True.

        Raises:
            TaskError: There is such a folder already.
        """
        folder = Path(self.log_path) / str(self.parameter("log_folder"))
        if folder.exists():
            raise TaskError(
                f"logs of '{folder.name}' are there already",
                file=str(folder),
                hint="delete the folder, or change the parameter log_folder",
            )
        formats = ["stdout", "csv", "tensorboard"]
        self.model.set_logger(stable_baselines3("common.logger").configure(str(folder), formats))
        return True

    def close_env(self) -> bool:
        """Close the environment; returns True."""
        if self.env is not None:
            self.env.close()
        return True

    def check_env(self) -> bool:
        """Check the environment as Stable-Baselines3 does; returns True."""
        check_env(self.env)
        return True

    def predict(
        self,
        observation: Any,
        state: Any = None,
        mask: Any = None,
        deterministic: bool = False,  # noqa: FBT001, FBT002
    ) -> Any:
        """Return the action for an observation, and the state of a recurrent policy.

        Args:
            observation: Observation.
            state: Of a recurrent policy.
            mask: Mask of beginning episodes, for a recurrent policy.
            deterministic: The best action instead of a drawn one.
        """
        return self.model.predict(
            observation, state=state, episode_start=mask, deterministic=deterministic
        )

    @classmethod
    def load_trained(cls, model_path: str, env: Any = None) -> BasicModel:
        """Return a saved model, for `predict`."""
        return cls(env, model_path, model_path, load_trained=True)
